#pragma once

#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>

#include "modules/viewer/orbit_control.hpp"
#include "modules/viewer/playback.hpp"
#include "modules/viewer/view_frame.hpp"
#include "modules/viewer/wheel.hpp"

namespace limbcast::viewer {

/// Frames in a window: the sheet, or the people from anywhere on all of it. The README lists keys
/// and what the mouse does.
class Window {
 public:
  /// Throws config::UsageError where there is no display.
  explicit Window(const Orbit& orbit);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// A slider over the frames of a log; `on_move` gets where the user puts it.
  void add_slider(int num_frames, std::function<void(int)> on_move);
  void move_slider(int frame);

  void show(ViewFrame frame);
  /// What the user asks of the playback; waits a moment for it. Draws the frame again where the
  /// user looks at it from elsewhere.
  std::optional<Command> poll();

 private:
  static void on_slider(int frame, void* window);
  static void on_mouse(int event, int u, int v, int flags, void* window);
  void drag_to(cv::Point pixel, bool pressed);
  void draw();

  std::unique_ptr<Wheel> wheel_;
  int slider_frame_ = 0;  ///< where the program has put it
  std::function<void(int)> on_slider_move_;
  std::optional<ViewFrame> frame_;
  OrbitControl control_;
  bool scene_alone_ = false;
  bool outdated_ = false;  ///< the user has asked for another view since the frame was drawn
  cv::Point mouse_;        ///< where it was last, in pixels of the sheet
};

}  // namespace limbcast::viewer
