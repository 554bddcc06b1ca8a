#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/whole_log.hpp"
#include "modules/simulate/frame_folder.hpp"
#include "modules/simulate/frame_messages.hpp"
#include "modules/simulate/options.hpp"

namespace limbcast::simulate {
namespace {

void declare(config::Section& section, Channels& channels) {
  section.add_output_channel("stereo-images-channel", channels.stereo_images, "pairs");
  section.add_output_channel("stereo-calibration-channel", channels.stereo_calibration,
                             "their calibration");
  section.add_output_channel("depth-images-channel", channels.depth_images,
                             "frames of a depth camera");
  section.add_output_channel("point-cloud-channel", channels.point_cloud, "clouds of a laser");
  section.add_output_channel("truth-channel", channels.truth, "the truth");
}

/// Calls `take` with each frame until all are made or the program is told to end; how many.
template <class Take>
int make_frames(const SimulateOptions& options, const SimulatorParams& params, const Take& take) {
  int i = 0;
  for (; i < options.frames && !lcm_io::stop_requested(); ++i) {
    take(simulate_frame(params, static_cast<std::uint64_t>(options.seed), options.first + i), i);
    if ((i + 1) % 10 == 0 || i + 1 == options.frames) {
      config::log(config::LogLevel::kInfo,
                  std::to_string(i + 1) + " of " + std::to_string(options.frames) + " frames made");
    }
  }
  return i;
}

/// What is not complete is no success. `what_is_left`: where it stands.
void check_complete(int num_made, const SimulateOptions& options, const std::string& what_is_left) {
  if (num_made == options.frames) return;
  throw std::runtime_error("interrupted: " + std::to_string(num_made) + " of " +
                           std::to_string(options.frames) + " frames; " + what_is_left);
}

void write_log(const SimulateOptions& options, const SimulatorParams& params,
               const Channels& channels) {
  config::check_output_file("--log", options.log);
  lcm_io::WholeLog log(options.log);
  const int num_made = make_frames(options, params, [&](const SimulatedFrame& frame, int i) {
    Outlet outlet(log.writer());
    FrameMessages(params, frame, options.sensor_name, i).send(channels, outlet);
  });
  log.close();
  check_complete(num_made, options, log.what_is_left("made"));
  log.finish();
}

void write_folder(const SimulateOptions& options, const SimulatorParams& params) {
  FrameFolder folder(options.output, params);
  const int num_made =
      make_frames(options, params, [&](const SimulatedFrame& frame, int) { folder.write(frame); });
  check_complete(num_made, options, options.output + " holds what was made so far");
}

/// Frames take longer to make than a sensor takes: they are made first, then sent at the sensor's
/// rate.
void publish(const SimulateOptions& options, const SimulatorParams& params,
             const Channels& channels, const config::CommonOptions& common) {
  lcm_io::Module module("simulate", common);
  Outlet outlet(module);
  std::vector<FrameMessages> messages;
  make_frames(options, params, [&](const SimulatedFrame& frame, int i) {
    messages.emplace_back(params, frame, options.sensor_name, i);
    module.spin_once();
  });
  Pacer pacer(options.rate_hz);
  std::int64_t sequence = 0;
  do {
    for (FrameMessages& message : messages) {
      wait_until(pacer.due(message.utime(), Pacer::Clock::now()), module);
      if (lcm_io::stop_requested()) break;
      message.restamp(lcm_io::utime_now(), sequence++);
      message.send(channels, outlet);
    }
  } while (options.loop && !lcm_io::stop_requested());
  config::log(config::LogLevel::kInfo, std::to_string(sequence) + " frames sent");
}

void report(const SimulateOptions& options, const SimulatorParams& params) {
  const std::string programs = std::filesystem::canonical("/proc/self/exe").parent_path().string();
  const std::vector<ReportRow> rows = make_report(params, options.report_params, programs,
                                                  static_cast<std::uint64_t>(options.seed));
  const std::size_t num_distances = distances_m(options.report_params).size();
  if (!rows.empty()) print_report(rows, options.report_params, std::cout);
  if (rows.size() < num_distances)
    throw std::runtime_error("interrupted: " + std::to_string(rows.size()) + " of " +
                             std::to_string(num_distances) + " distances");
}

void run(int argc, const char* const* argv) {
  SimulateOptions options;
  Channels channels;
  config::Section section("simulate");
  declare(section, options);
  declare(section, channels);
  config::Parser parser(
      "limbcast-simulate",
      "Makes recordings with truth of simulated people: as a folder, as a log, or live over LCM.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  const SimulatorParams params = to_params(options);
  refuse_options_of_others(options, parser);
  config::configure_log("simulate", parser.common().log_level);
  lcm_io::install_signal_handlers();
  if (options.report) {
    report(options, params);
  } else if (!options.output.empty()) {
    write_folder(options, params);
  } else if (!options.log.empty()) {
    write_log(options, params, channels);
  } else {
    publish(options, params, channels, parser.common());
  }
}

}  // namespace
}  // namespace limbcast::simulate

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-simulate",
                                       [&] { limbcast::simulate::run(argc, argv); });
}
