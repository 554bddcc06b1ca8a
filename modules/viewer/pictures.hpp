#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/viewer/viewpoint.hpp"

namespace limbcast::viewer {

/// Size of pictures that are not in the sensor's own lattice [px].
inline const cv::Size kPictureSize(640, 480);
/// Size of the sheet that shows all of them [px].
inline const cv::Size kSheetSize(1920, 720);

/// One picture and its name, which is part of its file's name.
struct Picture {
  std::string name;   ///< e.g. "skeleton"
  std::string title;  ///< what it shows, for people
  cv::Mat image;      ///< 8-bit BGR
};

// The pictures of the paper. A picture of what did not come is dark and says so.

/// What the camera saw, with the skin-coloured parts around the people and all seeds (fig. 3, 7
/// first row).
cv::Mat draw_input(const ViewFrame& frame);
/// Inverse distance in colours, red near, blue far, black unknown (fig. 3).
cv::Mat draw_disparity(const ViewFrame& frame);
/// The whole cloud from anywhere (fig. 3).
cv::Mat draw_whole_cloud(const ViewFrame& frame, const Orbit& orbit);
/// Each person's cluster in a colour of its own (fig. 4).
cv::Mat draw_segments_in_colors(const ViewFrame& frame);
/// Body poses over the image, the truth thin beside them (fig. 6).
cv::Mat draw_skeleton(const ViewFrame& frame);
/// Body poses among the cloud, dim, and the segments from anywhere (fig. 6 and 7).
cv::Mat draw_scene(const ViewFrame& frame, const Orbit& orbit, const cv::Size& size = kPictureSize);

/// All of them, in this order: cloud and poses from `orbit`, and the poses once more from above.
std::vector<Picture> draw_pictures(const ViewFrame& frame, const Orbit& orbit);

/// All pictures of a frame on one sheet, with titles and what was found in words.
cv::Mat draw_sheet(const ViewFrame& frame, const std::vector<Picture>& pictures);

}  // namespace limbcast::viewer
