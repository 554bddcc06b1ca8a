#include "modules/viewer/window.hpp"

#include <QtGlobal>
#include <cstdlib>
#include <map>
#include <opencv2/highgui.hpp>

#include "common/config/options.hpp"
#include "modules/viewer/picture_files.hpp"

namespace limbcast::viewer {
namespace {

const std::string kTitle = "limbcast", kSlider = "frame";
/// How long the window waits for a key before it looks whether it was closed.
constexpr int kPoll_ms = 20;
/// The window at its start [px]: the sheet's shape, on a screen of any usual size.
constexpr int kStartWidth_px = 1280, kStartHeight_px = 480;

/// Beyond letters, the codes are those of X (keysymdef.h), which OpenCV hands through.
const std::map<int, Command> kKeys = {
    {' ', Command::kPause},    {'s', Command::kNext},        {0xFF53, Command::kNext},
    {'a', Command::kPrevious}, {0xFF51, Command::kPrevious}, {0xFF56, Command::kForward},
    {0xFF55, Command::kBack},  {0xFF50, Command::kFirst},    {0xFF57, Command::kLast},
    {'q', Command::kQuit},     {27, Command::kQuit}};  // Escape
/// The key of + without shift is = on most keyboards.
const std::map<int, Look> kLookKeys = {
    {'j', Look::kLeft},   {'l', Look::kRight},  {'i', Look::kUp},      {'k', Look::kDown},
    {'+', Look::kNearer}, {'=', Look::kNearer}, {'-', Look::kFarther}, {'r', Look::kAsAtStart}};
constexpr int kSceneAloneKey = 'v';

const std::string kRemedy = "; write files with --png DIR or --video FILE";

bool has_display() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

/// Where no display answers Qt says so in several lines and aborts the program.
void end_where_qt_would(QtMsgType type, const QMessageLogContext& /*place*/,
                        const QString& /*text*/) {
  if (type != QtFatalMsg) return;
  std::_Exit(config::run_program("limbcast-viewer", [] {
    throw config::UsageError("the display does not answer, check DISPLAY" + kRemedy);
  }));
}

}  // namespace

Window::Window(const Orbit& orbit) : control_(orbit) {
  if (!has_display()) throw config::UsageError("there is no display for a window" + kRemedy);
  const QtMessageHandler usual = qInstallMessageHandler(end_where_qt_would);
  cv::namedWindow(kTitle, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO | cv::WINDOW_GUI_NORMAL);
  qInstallMessageHandler(usual);
  cv::resizeWindow(kTitle, kStartWidth_px, kStartHeight_px);
  cv::setMouseCallback(kTitle, &Window::on_mouse, this);
  wheel_ = std::make_unique<Wheel>([this](float notches) {
    control_.turn_wheel(notches);
    outdated_ = true;
  });
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

void Window::on_mouse(int /*event*/, int u, int v, int flags, void* window) {
  const bool pressed = (flags & (cv::EVENT_FLAG_LBUTTON | cv::EVENT_FLAG_RBUTTON)) != 0;
  static_cast<Window*>(window)->drag_to({u, v}, pressed);
}

void Window::drag_to(cv::Point pixel, bool pressed) {
  const cv::Point moved = pixel - mouse_;
  mouse_ = pixel;
  if (!pressed || moved == cv::Point()) return;
  control_.drag(static_cast<float>(moved.x) / static_cast<float>(kSheetSize.width),
                static_cast<float>(moved.y) / static_cast<float>(kSheetSize.height));
  outdated_ = true;
}

void Window::show(ViewFrame frame) {
  frame_ = std::move(frame);
  draw();
}

void Window::draw() {
  // Of the same size, so that the window keeps its shape.
  cv::imshow(kTitle, scene_alone_ ? draw_scene(*frame_, control_.orbit(), kSheetSize)
                                  : draw_frame(*frame_, control_.orbit()).sheet);
  outdated_ = false;
}

std::optional<Command> Window::poll() {
  const int key = cv::waitKeyEx(kPoll_ms);
  if (cv::getWindowProperty(kTitle, cv::WND_PROP_VISIBLE) < 1.0) return Command::kQuit;
  const auto look = kLookKeys.find(key);
  if (look != kLookKeys.end()) control_.apply(look->second);
  if (key == kSceneAloneKey) scene_alone_ = !scene_alone_;
  outdated_ = outdated_ || look != kLookKeys.end() || key == kSceneAloneKey;
  if (outdated_ && frame_) draw();
  const auto found = kKeys.find(key);
  return found == kKeys.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace limbcast::viewer
