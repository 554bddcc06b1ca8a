#include "common/sources/source_process.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <thread>

#include "common/camera/calibration_reader.hpp"
#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/input_error.hpp"
#include "common/sources/log_playback.hpp"
#include "common/sources/source_loop.hpp"
#include "common/units.hpp"

namespace limbcast {
namespace {

namespace fs = std::filesystem;

/// How long the process may take to see a signal.
constexpr std::chrono::milliseconds kTick{20};

/// Files that are read. A folder may hold logs besides, which are not.
std::vector<std::string> files_read(const SourceProcessOptions& options) {
  std::vector<std::string> inputs = calibration_files(options.calibration);
  inputs.insert(inputs.end(), {options.source.source, options.source.second_source});
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (!fs::is_directory(input, ignored)) {
      files.push_back(input);
      continue;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(input)) {
      if (entry.path().extension() != ".log") files.push_back(entry.path().string());
    }
  }
  return files;
}

/// A log that is not there would be taken for a source that needs a calibration.
void refuse_missing_log(const std::string& source) {
  if (fs::path(source).extension() == ".log" && !fs::exists(source))
    throw InputError(source + ": no such log; check the name");
}

/// For the log at start: the source, and what its devices can do.
std::string describe(const PairSource& source, const SourceOptions& options) {
  std::string text = source.description();
  for (const std::string& camera : {options.source, options.second_source}) {
    const std::string abilities = camera_abilities(camera);
    if (!abilities.empty()) text.append("; ").append(camera).append(": ").append(abilities);
  }
  return text;
}

}  // namespace

void show_statistics(const std::optional<SourceStatistics>& statistics, lcm_io::Module& module) {
  if (!statistics) return;
  module.set_note(std::to_string(statistics->dropped) + " dropped, " +
                  std::to_string(statistics->unpaired) + " unpaired, " +
                  std::to_string(statistics->reopened) + " reopened");
}

void ProblemReport::tell(const std::string& problem) {
  if (!problem.empty()) {
    module_.report_problem(problem);
  } else if (!last_.empty()) {
    module_.end_problem(last_);
  }
  last_ = problem;
}

void wait_until(Pacer::Clock::time_point due, lcm_io::Module& module) {
  while (!lcm_io::stop_requested()) {
    module.spin_once();
    const auto now = Pacer::Clock::now();
    if (now >= due) return;
    std::this_thread::sleep_for(std::min<Pacer::Clock::duration>(kTick, due - now));
  }
}

void require_input(const SourceProcessOptions& options, const std::string& program,
                   bool second_will_do) {
  const SourceOptions& cameras = options.source;
  const bool second_alone = second_will_do && !cameras.second_source.empty();
  for (const auto& [key, value] :
       {std::pair("source", second_alone ? &cameras.second_source : &cameras.source),
        std::pair("calibration", &options.calibration)}) {
    // A log carries the calibration with the images.
    if (key == std::string("calibration") && is_lcm_log(cameras.source)) continue;
    if (value->empty()) {
      refuse_missing_log(cameras.source);
      throw config::UsageError(std::string("--") + key + " is missing; see " + program + " --help");
    }
  }
}

void refuse_live_options(const std::string& recording, const std::vector<std::string>& keys,
                         const config::Parser& parser) {
  const std::string given = parser.on_command_line(keys);
  if (!given.empty())
    throw config::UsageError(recording + ": is a recording; leave out " + given +
                             " (for live sensors only)");
}

void keep_camera_options_out(SourceOptions& options, const std::string& second_key,
                             const config::Parser& parser) {
  if (is_camera(options.source) || !fs::exists(options.source)) return;
  refuse_live_options(options.source,
                      {"camera-width", "camera-height", "camera-rate", "camera-format", "exposure",
                       "gain", "pair-tolerance-ms", "open-timeout-s", "stall-timeout-s", "reopen"},
                      parser);
  const bool holds_both = fs::is_directory(options.source) || is_lcm_log(options.source);
  const bool of_use = !holds_both && !is_camera(options.second_source);
  if (!parser.on_command_line(second_key)) {
    if (!of_use) options.second_source.clear();
  } else if (holds_both && !options.second_source.empty()) {
    throw config::UsageError(options.source + ": holds all images; leave out " + second_key);
  }
}

void keep_start_time_out(const SourceOptions& options, const config::Parser& parser) {
  const std::string& source = options.source.empty() ? options.second_source : options.source;
  keep_start_time_out(source, is_camera(source) || is_lcm_log(source), parser);
}

void keep_start_time_out(const std::string& source, bool has_own_times,
                         const config::Parser& parser) {
  if (!parser.on_command_line("start-time-s")) return;
  const std::string timestamps = (fs::path(source) / "timestamps.csv").string();
  const bool has_timestamps = fs::is_directory(source) && fs::exists(timestamps);
  if (has_timestamps || has_own_times)
    throw config::UsageError((has_timestamps ? timestamps : source) +
                             ": tells the times of the frames; leave out start-time-s");
}

void require_end(const SourceProcessOptions& options) {
  if (options.log.empty() || !options.source.loop) return;
  throw config::UsageError("'log' and 'loop' together never end; leave one out");
}

void declare_playback(config::Section& section, SourceProcessOptions& options) {
  section.add_name("sensor", options.sensor, "name of the sensor in all messages");
  section.add_name("log", options.log, "write this LCM log instead of publishing");
  section.add("rate", options.source.rate_hz, "frames/s",
              "send at this rate; 0: as recorded, or 10 where no times are recorded",
              {0.0, 1000.0});
  section.add("loop", options.source.loop, "start a recording again at its end");
  section.add("restamp", options.restamp, "utime is the moment of sending, not the recorded one");
  section.add("start-time-s", options.start_time_s, "s",
              "time of the first frame where no times are recorded, since the Unix epoch",
              {0.0, 4e9});
  section.add("down", options.down, "gravity in the sensor's frame as X,Y,Z; overrides all others");
  section.add("sensor-height-m", options.sensor_height_m, "m",
              "height of the sensor over the ground, 0 = not told", {0.0, 100.0});
  section.add_channel("truth-channel", options.truth_channel,
                      "channel of the truth beside a recording");
}

void declare_cameras(config::Section& section, SourceOptions& options) {
  section.add("camera-width", options.camera.width, "px",
              "ask the camera for this size, 0 = the calibration's, else its own",
              {0, kMaxImageSide});
  section.add("camera-height", options.camera.height, "px",
              "ask the camera for this size, 0 = the calibration's, else its own",
              {0, kMaxImageSide});
  section.add("camera-rate", options.camera.rate_hz, "frames/s",
              "ask the camera for this rate, 0 = 30 or the nearest that it has", {0.0, 1000.0});
  section.add(
      "camera-format", options.camera.format,
      "ask the camera for this format, e.g. MJPG; empty: the fastest, at best without loss");
  section.add("exposure", options.camera.exposure, "driver's unit, UVC: 100 us",
              "fixed exposure; left out: as the camera has it");
  section.add("gain", options.camera.gain, "driver's unit",
              "fixed gain; left out: as the camera has it");
  section.add("pair-tolerance-ms", options.pair_tolerance_ms, "ms",
              "largest difference in time of the two images of two cameras", {0.0, 1000.0});
}

void declare(config::Section& section, SourceProcessOptions& options,
             const std::string& second_key) {
  SourceOptions& source = options.source;
  section.add(
      "source", source.source,
      "folder of pictures, video file, LCM log, /dev/videoN, gst:PIPELINE or a stream's URL");
  section.add(second_key, source.second_source,
              "camera or video of the second image, where it has one of its own");
  section.add("calibration", options.calibration,
              "calibration file: OpenCV YAML, or ROS camera_info YAML");
  declare_playback(section, options);
  section.add("jpeg-quality", source.jpeg_quality, "",
              "of pictures that are no JPEG yet; 0: PNG, without loss", {0, 100});
  declare_cameras(section, source);
  section.add("open-timeout-s", source.open_timeout_s, "s", "a camera must open within this time",
              {0.1, 3600.0});
  section.add("stall-timeout-s", source.stall_timeout_s, "s",
              "without a frame for this long a camera counts as stalled", {0.1, 3600.0});
  section.add("reopen", source.reopen,
              "open a camera that fails or ends again each second; false: end the program");
}

void check_log_file(const SourceProcessOptions& options) {
  config::check_output_file("--log", options.log, files_read(options));
}

Mounting mounting_of(const SourceProcessOptions& options) {
  Mounting mounting;
  if (options.sensor_height_m > 0.0) mounting.sensor_height_m = options.sensor_height_m;
  if (options.down.empty()) return mounting;
  std::istringstream text(options.down);
  Eigen::Vector3d down;
  char comma_1 = 0;
  char comma_2 = 0;
  text >> down.x() >> comma_1 >> down.y() >> comma_2 >> down.z();
  const bool readable = text && text.eof() && comma_1 == ',' && comma_2 == ',';
  // Typed with two digits a unit vector still has about this length.
  if (!readable || !(std::abs(down.norm() - 1.0) < 0.05)) {
    throw config::UsageError("'down' is '" + options.down + "', must be a unit vector like 0,1,0");
  }
  mounting.down = down.normalized();
  return mounting;
}

void Outlet::report_problem(const std::string& text) {
  if (module_ != nullptr) {
    module_->report_problem(text);
  } else {
    config::log(config::LogLevel::kError, text);
  }
}

void Outlet::set_note(const std::string& text) {
  if (module_ != nullptr) module_->set_note(text);
}

void run_source(const std::string& module_name, const SourceProcessOptions& options,
                const config::CommonOptions& common, const PairFormat& format,
                const Mounting& calibration, const SendFrame& send) {
  require_end(options);
  SourceOptions source_options = options.source;
  source_options.start_utime = std::llround(kMicrosecondsPerSecond<double> * options.start_time_s);
  FrameSender<FramePair> sender(options, calibration, send);
  const std::unique_ptr<PairSource> source = open_source(source_options, format);
  run_frames(module_name, options, common, *source, sender, describe(*source, source_options));
}

}  // namespace limbcast
