#pragma once

#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "modules/viewer/pictures.hpp"

namespace limbcast::viewer {

/// Pictures of one frame, and the sheet that shows them all.
struct DrawnFrame {
  int number = 0;
  std::vector<Picture> pictures;
  cv::Mat sheet;
};

DrawnFrame draw_frame(const ViewFrame& frame, const Orbit& orbit);

/// Writes frame_00012_skeleton.png ... and frame_00012_sheet.png into `folder`. Throws
/// std::runtime_error where a file cannot be written.
void write_pictures(const std::string& folder, const DrawnFrame& frame);

/// A video of the sheets. The file's ending chooses the format: .avi (Motion JPEG) or .mp4
/// (MPEG-4).
class SheetVideo {
 public:
  /// Throws InputError for another ending.
  SheetVideo(std::string path, double frames_per_s);
  /// Throws std::runtime_error where the file cannot be made.
  void write(const DrawnFrame& frame);
  /// After the last frame. Throws std::runtime_error where the file does not hold all of them.
  void finish();

 private:
  std::string path_;
  double frames_per_s_;
  int codec_;
  int num_frames_ = 0;
  cv::VideoWriter writer_;
};

}  // namespace limbcast::viewer
