#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <limits>
#include <memory>
#include <thread>

#include "common/config/log.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"
#include "modules/viewer/frame_assembler.hpp"
#include "modules/viewer/picture_files.hpp"
#include "modules/viewer/window.hpp"

namespace limbcast::viewer {
namespace {

using config::log;
using config::LogLevel;

/// Truth follows its frame in a replayed log; a recorded one may be some frames late.
constexpr int kWaitInLogs = 4;

struct Options {
  std::string log, png, video;
  std::string point_cloud = "POINT_CLOUD", segments = "SEGMENTS", poses = "BODY_POSES";
  std::string truth = "GROUND_TRUTH";
  int every = 1, max = 0;
  double rate_hz = 5.0;
};

void declare(config::Section& section, Options& options) {
  section.add("png", options.png, "folder to write pictures to; default: a window");
  section.add("video", options.video, "file to write the sheets to as a video, .avi or .mp4");
  section.add("every", options.every, "", "draw every n-th frame only", {1, 1000000});
  section.add("max", options.max, "", "end after so many frames, 0 = all", {0, 1000000000});
  section.add("rate", options.rate_hz, "frames/s", "speed of the video, and of a log in a window",
              {0.1, 1000.0});
  section.add("point-cloud-channel", options.point_cloud, "clouds to draw");
  section.add("segments-channel", options.segments, "segments to draw");
  section.add("poses-channel", options.poses, "poses to draw: BODY_POSES or TRACKED_POSES");
  section.add("truth-channel", options.truth, "truth to draw");
}

/// Draws frames and puts them where the user wants them.
class Output {
 public:
  explicit Output(const Options& options) : options_(options) {
    if (!options.png.empty()) make_folder(options.png);
    if (!options.video.empty())
      video_ = std::make_unique<SheetVideo>(options.video, options.rate_hz);
    if (options.png.empty() && options.video.empty()) window_ = std::make_unique<Window>();
  }

  void add(ViewFrame frame, std::size_t max_batch) {
    if (frame.number % options_.every != 0 || done()) return;
    ++num_frames_;
    batch_.push_back(std::move(frame));
    if (batch_.size() >= max_batch) flush();
  }
  /// Draws what is waiting, several frames side by side.
  void flush() {
    std::vector<DrawnFrame> drawn(batch_.size());
    tbb::parallel_for(std::size_t{0}, batch_.size(), [&](std::size_t i) {
      drawn[i] = draw_frame(batch_[i]);
      if (!options_.png.empty()) write_pictures(options_.png, drawn[i]);
    });
    for (const DrawnFrame& frame : drawn) {
      if (video_) video_->write(frame);
      if (window_)
        window_->show(frame,
                      options_.log.empty() ? 1 : static_cast<int>(1000.0 / options_.rate_hz));
    }
    batch_.clear();
  }
  void poll() {
    if (window_) window_->poll();
  }
  bool done() const {
    return (options_.max > 0 && num_frames_ >= options_.max) || (window_ && window_->closed()) ||
           lcm_io::stop_requested();
  }
  int num_frames() const { return num_frames_; }
  bool has_window() const { return window_ != nullptr; }

 private:
  static void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
      throw config::UsageError(folder + ": cannot be made; give a folder to --png");
  }

  Options options_;
  std::unique_ptr<SheetVideo> video_;
  std::unique_ptr<Window> window_;
  std::vector<ViewFrame> batch_;
  int num_frames_ = 0;
};

/// Decodes a message of one of the channels into the assembler; false for other channels.
bool take(const lcm_io::LogEvent& event, const Options& options, FrameAssembler& assembler) {
  using lcm_io::decode;
  if (event.channel == options.point_cloud) {
    assembler.add(lcm_io::from_message(decode<point_cloud_t>(event.data)));
  } else if (event.channel == options.segments) {
    assembler.add(lcm_io::from_message(decode<segments_t>(event.data)));
  } else if (event.channel == options.poses) {
    assembler.add(lcm_io::from_message(decode<body_poses_t>(event.data)));
  } else if (event.channel == options.truth) {
    assembler.add_truth(lcm_io::from_message(decode<body_poses_t>(event.data)));
  } else {
    return false;
  }
  return true;
}

void view_log(const Options& options) {
  lcm_io::LogReader reader(options.log);
  Output output(options);
  FrameAssembler assembler(kWaitInLogs);
  const std::size_t batch =
      output.has_window() ? 1 : std::max(1U, std::thread::hardware_concurrency());
  int malformed = 0;
  while (!output.done()) {
    const auto event = reader.next();
    if (!event) break;
    try {
      take(*event, options, assembler);
    } catch (const lcm_io::MessageError& error) {
      if (malformed++ == 0)
        log(LogLevel::kWarning, event->channel + ": message dropped: " + error.what());
    }
    while (auto frame = assembler.next()) output.add(std::move(*frame), batch);
  }
  while (!output.done()) {
    auto frame = assembler.next_at_end();
    if (!frame) break;
    output.add(std::move(*frame), batch);
  }
  output.flush();
  if (malformed > 1) log(LogLevel::kWarning, std::to_string(malformed) + " messages dropped");
  if (reader.torn_bytes() > 0)
    log(LogLevel::kWarning, options.log + ": is torn, its last " +
                                std::to_string(reader.torn_bytes()) + " bytes were left out");
  if (output.num_frames() == 0)
    log(LogLevel::kWarning,
        options.log + ": holds no clouds, segments or poses to draw; limbcast-replay adds them");
  else
    log(LogLevel::kInfo, std::to_string(output.num_frames()) + " frames drawn");
}

void view_live(const Options& options, const std::string& lcm_url) {
  Output output(options);
  FrameAssembler assembler(0);
  lcm_io::wait_for_network(lcm_url);
  lcm_io::Bus bus(lcm_url);
  bus.set_on_malformed([](const std::string& channel, const std::string& reason) {
    log(LogLevel::kWarning, channel + ": message dropped: " + reason);
  });
  // Sent frames are not skipped one channel at a time: their messages would no longer belong
  // together.
  bus.subscribe<point_cloud_t>(
      options.point_cloud, lcm_io::Keep::kAll,
      [&](const point_cloud_t& message) { assembler.add(lcm_io::from_message(message)); });
  bus.subscribe<segments_t>(options.segments, lcm_io::Keep::kAll, [&](const segments_t& message) {
    assembler.add(lcm_io::from_message(message));
  });
  bus.subscribe<body_poses_t>(options.poses, lcm_io::Keep::kAll, [&](const body_poses_t& message) {
    assembler.add(lcm_io::from_message(message));
  });
  bus.subscribe<body_poses_t>(options.truth, lcm_io::Keep::kAll, [&](const body_poses_t& message) {
    assembler.add_truth(lcm_io::from_message(message));
  });
  log(LogLevel::kInfo, "shows " + options.poses + " of " + lcm_io::effective_url(lcm_url));
  while (!output.done()) {
    // Take in all that has come before drawing, then draw the newest frame that is complete.
    while (bus.handle(std::chrono::milliseconds(20))) {
    }
    std::optional<ViewFrame> newest;
    while (auto frame = assembler.next()) newest = std::move(frame);
    if (newest) output.add(std::move(*newest), 1);
    output.poll();
  }
}

void run(int argc, const char* const* argv) {
  Options options;
  config::Section section("viewer");
  declare(section, options);
  config::Parser parser(
      "limbcast-viewer",
      "Draws clouds, segments and poses: pictures, a video, or a window (space: pause, s: "
      "step, q: quit).");
  parser.add_positional("[LOG]", options.log,
                        "log made by limbcast-replay or lcm-logger; default: live");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("viewer", parser.common().log_level);
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
