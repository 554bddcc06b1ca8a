#include "common/camera/picture_file.hpp"

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "common/input_error.hpp"

namespace limbcast {

void check_picture_ending(const std::string& path) {
  if (!path.empty() && !cv::haveImageWriter(path))
    throw InputError(path + ": no picture format has this ending; use .png");
}

void write_picture(const std::string& path, const cv::Mat& image) {
  if (!cv::imwrite(path, image)) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace limbcast
