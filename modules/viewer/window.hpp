#pragma once

#include "modules/viewer/picture_files.hpp"

namespace limbcast::viewer {

/// The sheets in a window. Keys: space pauses and goes on, s shows the next frame only, q or Escape
/// ends.
class Window {
 public:
  /// Throws config::UsageError where there is no display.
  Window();
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Shows the frame for `duration_ms`, or until a key while paused.
  void show(const DrawnFrame& frame, int duration_ms);
  /// Lets the window answer keys while no frame comes.
  void poll();
  bool closed() const { return closed_; }

 private:
  void on_key(int key);

  bool closed_ = false, paused_ = false;
  bool step_ = false;  ///< go on for one frame
};

}  // namespace limbcast::viewer
