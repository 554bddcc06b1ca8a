#include <cstdio>
#include <limbcast/body_poses_t.hpp>
#include <stdexcept>

#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/pose_log.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "common/pose_json/pose_text.hpp"

namespace limbcast::export_poses {
namespace {

/// How long the live export may take to see a signal.
constexpr std::chrono::milliseconds kWait{50};

struct Options {
  std::string log, channel = "BODY_POSES", format = "json";
};

/// A reader that closes the pipe or a full disk must not pass for a complete file.
void write_poses(const BodyPoses& poses, const Options& options) {
  const std::string text =
      options.format == "json" ? pose_json::to_line(poses) + "\n" : pose_json::to_text(poses);
  if (std::fputs(text.c_str(), stdout) < 0) throw config::cannot_write_to_stdout();
}

void flush_lines() {
  if (std::fflush(stdout) != 0) throw config::cannot_write_to_stdout();
}

void export_log(const Options& options) {
  const auto summary = lcm_io::visit_poses(
      options.log, options.channel, [&](const BodyPoses& poses) { write_poses(poses, options); });
  flush_lines();
  lcm_io::warn_about(summary, options.log, options.channel);
  if (summary.messages == 0)
    throw config::UsageError(
        lcm_io::no_poses_on(options.channel, options.log, summary.other_channels));
}

void export_live(const Options& options, const std::string& lcm_url) {
  lcm_io::wait_for_network(lcm_url);
  lcm_io::Bus bus(lcm_url);
  bus.set_on_malformed([](const std::string& channel, const std::string& reason) {
    config::log(config::LogLevel::kWarning, channel + ": message dropped: " + reason);
  });
  bus.subscribe<body_poses_t>(options.channel, lcm_io::Keep::kAll,
                              [&](const body_poses_t& message) {
                                write_poses(lcm_io::from_message(message), options);
                                flush_lines();
                              });
  lcm_io::install_signal_handlers();
  config::log(config::LogLevel::kInfo,
              "writes " + options.channel + " of " + lcm_io::effective_url(lcm_url));
  while (!lcm_io::stop_requested()) bus.handle(kWait);
}

void run(int argc, const char* const* argv) {
  Options options;
  config::Section section("export_poses");
  section.add_channel("channel", options.channel, "poses to write: BODY_POSES or TRACKED_POSES");
  section.add_choice("format", options.format, {"json", "text"},
                     "a line of JSON for each frame, or a readable line for each person");
  config::Parser parser("limbcast-export-poses",
                        "Writes poses from a log or live, a line a frame.");
  parser.add_positional("[LOG]", options.log, "log that holds poses; default: live until Ctrl-C");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("export_poses", parser.common().log_level);
  if (options.log.empty()) {
    export_live(options, parser.common().lcm_url);
  } else {
    export_log(options);
  }
}

}  // namespace
}  // namespace limbcast::export_poses

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-export-poses",
                                       [&] { limbcast::export_poses::run(argc, argv); });
}
