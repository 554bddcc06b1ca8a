#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "modules/viewer/playback.hpp"

namespace limbcast::viewer {

/// The sheets in a window. Keys: space pauses and goes on; s or right one frame on, a or left one
/// back; page down and up ten; home, end; q or Escape ends, as closing the window does.
class Window {
 public:
  /// Throws config::UsageError where there is no display.
  Window();
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// A slider over the frames of a log; `on_move` gets where the user puts it.
  void add_slider(int num_frames, std::function<void(int)> on_move);
  void move_slider(int frame);

  void show(const cv::Mat& sheet);
  /// What the user asks for; waits a moment for it.
  std::optional<Command> poll();

 private:
  static void on_slider(int frame, void* window);

  int slider_frame_ = 0;  ///< where the program has put it
  std::function<void(int)> on_slider_move_;
};

}  // namespace limbcast::viewer
