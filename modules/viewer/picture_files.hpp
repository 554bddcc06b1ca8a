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
/// (MPEG-4). It takes its place when it is whole (see unfinished_file): until then an earlier one
/// is as it was.
class SheetVideo {
 public:
  /// Throws InputError for another ending.
  SheetVideo(std::string path, double frames_per_s);
  /// Where it stands until it is whole.
  const std::string& unfinished() const { return unfinished_; }
  /// Throws std::runtime_error where the file cannot be made.
  void write(const DrawnFrame& frame);
  /// After the last frame: puts it in its place. Throws std::runtime_error where it does not hold
  /// all of them, or none came.
  void finish();
  /// Closes what does not become whole, and says where it stands.
  std::string leave_unfinished();

 private:
  void close();

  std::string path_, ending_, unfinished_;
  double frames_per_s_;
  int codec_;
  int num_frames_ = 0;
  cv::VideoWriter writer_;
};

}  // namespace limbcast::viewer
