#include "modules/calibrate/output.hpp"

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "common/config/options.hpp"

namespace limbcast::calibrate {

void write_picture(const std::string& path, const cv::Mat& image) {
  bool written = false;
  try {
    written = cv::imwrite(path, image);
  } catch (const cv::Exception&) {
    throw config::UsageError(path + ": no picture format has this ending; use .png");
  }
  if (!written) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace limbcast::calibrate
