#include "common/camera/picture_file.hpp"

#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"

namespace limbcast {

void check_picture_ending(const std::string& path) {
  if (!path.empty() && !cv::haveImageWriter(path))
    throw InputError(path + ": no picture format has this ending; use .png");
}

void write_picture(const std::string& path, const cv::Mat& image, const std::vector<int>& params) {
  // Coded in memory: of a full disk libpng says words of its own on stderr.
  std::vector<std::uint8_t> bytes;
  cv::imencode(std::filesystem::path(path).extension().string(), image, bytes, params);
  write_whole_file(path, bytes);
}

}  // namespace limbcast
