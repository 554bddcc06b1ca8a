#include "common/camera/picture_file.hpp"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "common/file_extension.hpp"
#include "common/input_error.hpp"
#include "common/whole_file.hpp"

namespace limbcast {

void check_picture_ending(const std::string& path) {
  // OpenCV knows more, and of some it says only when a picture is done that it takes no colours.
  static const std::set<std::string> endings = {".png", ".jpg", ".jpeg"};
  if (!path.empty() && endings.count(extension_of(path)) == 0)
    throw InputError(path + ": pictures are written as .png or .jpg; choose such an ending");
}

void write_picture(const std::string& path, const cv::Mat& image, const std::vector<int>& params) {
  // Coded in memory: of a full disk libpng says words of its own on stderr.
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension_of(path), image, bytes, params);
  write_whole_file(path, bytes);
}

}  // namespace limbcast
