#include "modules/viewer/window.hpp"

#include <cstdlib>
#include <map>
#include <opencv2/highgui.hpp>

#include "common/config/options.hpp"

namespace limbcast::viewer {
namespace {

const std::string kTitle = "limbcast", kSlider = "frame";
/// How long the window waits for a key before it looks whether it was closed.
constexpr int kPoll_ms = 20;

/// Beyond letters, the codes are those of X (keysymdef.h), which OpenCV hands through.
const std::map<int, Command> kKeys = {
    {' ', Command::kPause},    {'s', Command::kNext},        {0xFF53, Command::kNext},
    {'a', Command::kPrevious}, {0xFF51, Command::kPrevious}, {0xFF56, Command::kForward},
    {0xFF55, Command::kBack},  {0xFF50, Command::kFirst},    {0xFF57, Command::kLast},
    {'q', Command::kQuit},     {27, Command::kQuit}};  // Escape

bool has_display() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

}  // namespace

Window::Window() {
  if (!has_display())
    throw config::UsageError(
        "there is no display for a window; write files with --png DIR or --video FILE");
  cv::namedWindow(kTitle, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO | cv::WINDOW_GUI_NORMAL);
}

Window::~Window() { cv::destroyAllWindows(); }

void Window::add_slider(int num_frames, std::function<void(int)> on_move) {
  on_slider_move_ = std::move(on_move);
  if (num_frames > 1)
    cv::createTrackbar(kSlider, kTitle, nullptr, num_frames - 1, &Window::on_slider, this);
}

void Window::move_slider(int frame) {
  slider_frame_ = frame;
  cv::setTrackbarPos(kSlider, kTitle, frame);
}

void Window::on_slider(int frame, void* window) {
  auto* self = static_cast<Window*>(window);
  // OpenCV also calls where the program has moved it.
  if (frame != self->slider_frame_) self->on_slider_move_(frame);
}

void Window::show(const cv::Mat& sheet) { cv::imshow(kTitle, sheet); }

std::optional<Command> Window::poll() {
  const int key = cv::waitKeyEx(kPoll_ms);
  if (cv::getWindowProperty(kTitle, cv::WND_PROP_VISIBLE) < 1.0) return Command::kQuit;
  const auto found = kKeys.find(key);
  return found == kKeys.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace limbcast::viewer
