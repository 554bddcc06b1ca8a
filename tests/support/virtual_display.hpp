#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"

namespace limbcast::test {

/// A screen without a monitor (Xvfb), on which programs with windows run; ends with its object.
/// There is no window manager: windows stand where they were put, undecorated.
class VirtualDisplay {
 public:
  /// Whether Xvfb, xdotool and ImageMagick are there; a test that needs them is skipped otherwise.
  static bool available();

  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// "DISPLAY=:7", for the environment of a program.
  const std::string& variable() const { return variable_; }

  /// Identifier of the window of that title once it is there; empty when `program` ended before.
  std::string window(const std::string& title, ChildProcess& program) const;
  bool has_window(const std::string& title) const;
  /// Puts a window in front, with its upper left corner at (0, 0).
  void show(const std::string& window, cv::Size size) const;
  void press(const std::string& window, const std::string& key) const;
  void double_click(cv::Point pixel) const;
  /// With the left button.
  void drag(cv::Point from, cv::Point to) const;
  /// One notch; away from the user is up.
  void turn_wheel(cv::Point pixel, bool up) const;
  /// The whole screen, 8-bit BGR.
  cv::Mat screenshot() const;

 private:
  RunResult tool(const std::vector<std::string>& command) const;

  std::string folder_, variable_;
  std::unique_ptr<ChildProcess> server_;
  int server_output_ = -1;
};

}  // namespace limbcast::test
