#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "common/bounded_map.hpp"
#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/module_status_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/pose_log.hpp"
#include "common/lcm_io/segments_codec.hpp"
#include "modules/viewer/frame_assembler.hpp"
#include "modules/viewer/log_frames.hpp"
#include "modules/viewer/picture_files.hpp"
#include "modules/viewer/window.hpp"

namespace limbcast::viewer {
namespace {

using config::log;
using config::LogLevel;

struct Options {
  std::string log, png, video;
  ViewChannels channels;
  int every = 1, max = 0;
  double rate_hz = 5.0;
  Orbit orbit{65.0F, 10.0F};
};

void declare(config::Section& section, Options& options) {
  section.add_name("png", options.png, "folder to write pictures to; default: a window");
  section.add_name("video", options.video, "file to write the sheets to as a video, .avi or .mp4");
  section.add("every", options.every, "", "draw every n-th frame only", {1, 1000000});
  section.add("max", options.max, "", "end after so many frames, 0 = all", {0, 1000000000});
  section.add("rate", options.rate_hz, "frames/s", "speed of the video, and of a log in a window",
              {0.1, 1000.0});
  section.add("azimuth-deg", options.orbit.azimuth_deg, "degrees",
              "look at cloud and poses from so far to the side: 0 the sensor, 90 right of it",
              {-360.0F, 360.0F});
  section.add("elevation-deg", options.orbit.elevation_deg, "degrees",
              "and from so far above: 0 as high as the people, 90 straight above, -90 below",
              {-90.0F, 90.0F});
  section.add("zoom", options.orbit.zoom, "", "and so many times nearer than to see all of them",
              {kMinZoom, kMaxZoom});
  section.add_channel("point-cloud-channel", options.channels.point_cloud, "clouds to draw");
  section.add_channel("segments-channel", options.channels.segments, "segments to draw");
  section.add_channel("poses-channel", options.channels.poses,
                      "poses to draw: BODY_POSES or TRACKED_POSES");
  section.add_channel("truth-channel", options.channels.truth, "truth to draw");
  section.add_channel("status-channel", options.channels.status,
                      "rates and latencies of the modules");
}

bool to_window(const Options& options) { return options.png.empty() && options.video.empty(); }

/// Draws frames into files.
class Output {
 public:
  explicit Output(const Options& options) : options_(options) {
    if (!options.png.empty()) config::make_output_folder("--png", options.png);
    if (!options.video.empty())
      video_ = std::make_unique<SheetVideo>(options.video, options.rate_hz);
  }

  /// Several frames side by side.
  void write(const std::vector<ViewFrame>& frames) {
    std::vector<DrawnFrame> drawn(frames.size());
    tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
      drawn[i] = draw_frame(frames[i], options_.orbit);
      if (!options_.png.empty()) write_pictures(options_.png, drawn[i]);
    });
    if (!video_) return;
    if (!lock_) lock_.emplace(video_->unfinished());
    for (const DrawnFrame& frame : drawn) video_->write(frame);
  }

  /// After the last frame.
  void finish() {
    if (video_) video_->finish();
  }
  /// Instead, where the program was told to end before: says what there is then.
  std::string leave_unfinished() {
    return video_ ? video_->leave_unfinished() : "what was drawn so far is kept";
  }

 private:
  Options options_;
  std::unique_ptr<SheetVideo> video_;
  std::optional<lcm_io::FileLock> lock_;  ///< no other process writes the video
};

/// The numbers of the frames that the user wants.
std::vector<int> wanted_frames(const Options& options, int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; i += options.every)
    if (options.max == 0 || static_cast<int>(numbers.size()) < options.max) numbers.push_back(i);
  return numbers;
}

std::string count_text(std::size_t drawn, std::size_t all) {
  return std::to_string(drawn) + " of " + std::to_string(all) + " frames";
}

/// Says what was drawn where the program was told to end before the last frame; else nothing.
std::string write_log(const Options& options, LogFrames& log, const std::vector<int>& numbers) {
  Output output(options);
  const std::size_t batch = std::max(1U, std::thread::hardware_concurrency());
  std::size_t i = 0;
  while (i < numbers.size() && !lcm_io::stop_requested()) {
    std::vector<ViewFrame> frames;
    for (; i < numbers.size() && frames.size() < batch; ++i)
      frames.push_back(log.frame(numbers[i]));
    output.write(frames);
  }
  if (i < numbers.size()) return count_text(i, numbers.size()) + "; " + output.leave_unfinished();
  output.finish();
  return "";
}

/// Until the user ends it.
void show_log(const Options& options, LogFrames& log, const std::vector<int>& numbers) {
  using Clock = std::chrono::steady_clock;
  const auto period = std::chrono::duration<double>(1.0 / options.rate_hz);
  Window window(options.orbit);
  Playback playback(static_cast<int>(numbers.size()));
  window.add_slider(static_cast<int>(numbers.size()), [&](int i) { playback.seek(i); });
  int shown = -1;
  Clock::time_point since;
  while (!playback.ended() && !lcm_io::stop_requested()) {
    if (playback.frame() != shown) {
      shown = playback.frame();
      window.show(log.frame(numbers[static_cast<std::size_t>(shown)]));
      window.move_slider(shown);
      since = Clock::now();
    }
    if (const auto command = window.poll()) playback.apply(*command);
    if (Clock::now() - since >= period) playback.advance();
  }
}

/// Clouds are worth a look without poses, but who has poses elsewhere gave the wrong channel.
void check_content(const Options& options, const LogFrames& log_frames) {
  if (log_frames.has_poses()) return;
  const ViewChannels& channels = options.channels;
  const std::set<std::string>& others = log_frames.other_pose_channels();
  if (log_frames.count() == 0 && others.empty())
    throw config::UsageError(options.log + ": holds nothing to draw on " + channels.point_cloud +
                             ", " + channels.segments + " or " + channels.poses +
                             "; limbcast-replay adds it");
  const std::string text = lcm_io::no_poses_on(channels.poses, options.log, others);
  if (!others.empty()) throw config::UsageError(text);
  log(LogLevel::kWarning, text);
}

void view_log(const Options& options) {
  LogFrames log_frames(options.log, options.channels);
  check_content(options, log_frames);
  const std::vector<int> numbers = wanted_frames(options, log_frames.count());
  const bool windowed = to_window(options);
  std::string left_by_interrupt;
  if (windowed)
    show_log(options, log_frames, numbers);
  else
    left_by_interrupt = write_log(options, log_frames, numbers);
  if (log_frames.num_malformed() > 1)
    log(LogLevel::kWarning, std::to_string(log_frames.num_malformed()) + " messages dropped");
  if (log_frames.torn_bytes() > 0)
    log(LogLevel::kWarning, lcm_io::torn_end(options.log, log_frames.torn_bytes()));
  if (windowed) return;
  if (!left_by_interrupt.empty()) throw std::runtime_error("interrupted: " + left_by_interrupt);
  log(LogLevel::kInfo, count_text(numbers.size(), numbers.size()) + " drawn");
}

/// Whose figures are shown: more than run on all hosts of a robot.
constexpr std::size_t kMostModules = 500;

/// What comes over LCM, put together.
class LiveFrames {
 public:
  LiveFrames(const ViewChannels& channels, const std::string& lcm_url) : bus_(lcm_url) {
    bus_.set_on_malformed([](const std::string& channel, const std::string& reason) {
      log(LogLevel::kWarning, channel + ": message dropped: " + reason);
    });
    take<point_cloud_t>(channels.point_cloud, [this](auto cloud) { assembler_.add(cloud); });
    take<segments_t>(channels.segments, [this](auto segments) { assembler_.add(segments); });
    take<body_poses_t>(channels.poses, [this](auto poses) { assembler_.add(poses); });
    take<body_poses_t>(channels.truth, [this](auto truth) { assembler_.add_truth(truth); });
    take<module_status_t>(channels.status, [this](const lcm_io::ModuleStatus& status) {
      const ModuleFigures figures = figures_of(status);
      modules_.get(figures.host + '\n' + figures.module) = figures;
    });
  }

  /// The newest complete frame of what has come; nothing where none is new.
  std::optional<ViewFrame> newest() {
    // What has come, and no more: at many frames a second there is always a next message.
    if (bus_.handle(std::chrono::milliseconds(20))) {
      while (bus_.handle(std::chrono::milliseconds(0))) continue;
    }
    std::optional<ViewFrame> newest;
    while (auto frame = assembler_.next()) newest = std::move(frame);
    if (newest)
      modules_.for_each([&newest](const std::string& /*name*/, const ModuleFigures& figures) {
        newest->modules.push_back(figures);
      });
    return newest;
  }

 private:
  /// All of them: were they skipped one channel at a time, they would no longer belong together.
  template <class Message, class Handler>
  void take(const std::string& channel, Handler handler) {
    bus_.subscribe<Message>(channel, lcm_io::Keep::kAll, [handler](const Message& message) {
      handler(lcm_io::from_message(message));
    });
  }

  lcm_io::Bus bus_;
  FrameAssembler assembler_;
  BoundedMap<ModuleFigures> modules_{kMostModules};
};

void view_live(const Options& options, const std::string& lcm_url) {
  std::unique_ptr<Window> window;
  std::unique_ptr<Output> output;
  if (to_window(options))
    window = std::make_unique<Window>(options.orbit);
  else
    output = std::make_unique<Output>(options);
  lcm_io::wait_for_network(lcm_url);
  LiveFrames frames(options.channels, lcm_url);
  log(LogLevel::kInfo, "shows " + options.channels.poses + " of " + lcm_io::effective_url(lcm_url));
  int num_drawn = 0;
  bool paused = false, step = false;
  while (!lcm_io::stop_requested() && (options.max == 0 || num_drawn < options.max)) {
    const auto frame = frames.newest();
    if (frame && (!paused || step) && frame->number % options.every == 0) {
      ++num_drawn;
      step = false;
      if (window) window->show(*frame);
      if (output) output->write({*frame});
    }
    const auto command = window ? window->poll() : std::nullopt;
    if (command == Command::kQuit) return;
    if (command == Command::kPause) paused = !paused;
    if (command == Command::kNext) paused = step = true;
  }
  if (output) output->finish();
}

void run(int argc, const char* const* argv) {
  Options options;
  config::Section section("viewer");
  declare(section, options);
  config::Parser parser(
      "limbcast-viewer",
      "Draws clouds, segments and poses: pictures, a video, or a window (space: pause, s "
      "and a: one frame on and back, q: quit; a slider over a log; drag or i j k l: look from "
      "elsewhere, wheel or + and -: nearer and farther, r: as at the start, v: the people alone).");
  parser.add_positional("[LOG]", options.log,
                        "log made by limbcast-replay or lcm-logger; default: live");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("viewer", parser.common().log_level);
  config::check_output_file("--video", options.video, {options.log});
  lcm_io::install_signal_handlers();
  if (options.log.empty()) {
    view_live(options, parser.common().lcm_url);
  } else {
    view_log(options);
  }
}

}  // namespace
}  // namespace limbcast::viewer

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-viewer",
                                       [&] { limbcast::viewer::run(argc, argv); });
}
