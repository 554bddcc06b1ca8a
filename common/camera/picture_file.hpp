#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace limbcast {

/// Throws InputError where the path's ending is no picture format's; an empty path is none given.
/// To be asked before the work that the picture is to show.
void check_picture_ending(const std::string& path);

/// Writes a picture in the format of the path's ending, with the parameters of cv::imwrite. Throws
/// std::runtime_error where it cannot be written.
void write_picture(const std::string& path, const cv::Mat& image,
                   const std::vector<int>& params = {});

}  // namespace limbcast
