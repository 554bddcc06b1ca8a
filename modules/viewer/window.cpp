#include "modules/viewer/window.hpp"

#include <cstdlib>
#include <opencv2/highgui.hpp>

#include "common/config/options.hpp"

namespace limbcast::viewer {
namespace {

const std::string kTitle = "limbcast";
constexpr int kEscape = 27;
/// How long the window waits for a key before it looks whether it was closed.
constexpr int kPoll_ms = 20;

bool has_display() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

}  // namespace

Window::Window() {
  if (!has_display())
    throw config::UsageError(
        "there is no display for a window; write files with --png DIR or --video FILE");
  cv::namedWindow(kTitle, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO);
}

Window::~Window() { cv::destroyAllWindows(); }

void Window::on_key(int key) {
  if (key == 'q' || key == kEscape) closed_ = true;
  if (key == ' ') paused_ = !paused_;
  if (key == 's') paused_ = step_ = true;
}

void Window::poll() {
  on_key(cv::waitKey(kPoll_ms));
  if (cv::getWindowProperty(kTitle, cv::WND_PROP_VISIBLE) < 1.0) closed_ = true;
}

void Window::show(const DrawnFrame& frame, int duration_ms) {
  step_ = false;
  cv::imshow(kTitle, frame.sheet);
  for (int shown_ms = 0; !closed_ && (shown_ms < duration_ms || (paused_ && !step_));
       shown_ms += kPoll_ms)
    poll();
}

}  // namespace limbcast::viewer
