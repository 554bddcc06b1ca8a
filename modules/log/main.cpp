#include <cstdio>
#include <stdexcept>

#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/config/output_file.hpp"
#include "common/config/version.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/log/cut.hpp"
#include "modules/log/extract.hpp"
#include "modules/log/log_info.hpp"

namespace limbcast::logs {
namespace {

using config::log;
using config::LogLevel;
using config::UsageError;

constexpr const char* kUsage =
    "limbcast-log: Says what is in LCM logs, cuts, merges and unpacks them.\n\n"
    "Usage: limbcast-log COMMAND ... (limbcast-log COMMAND --help tells its options)\n"
    "  info LOG...             channels, types, rates, gaps, losses, calibration, hosts\n"
    "  cut IN.log OUT.log      a part by time, frames or channels\n"
    "  merge OUT.log IN.log... several logs in the order of time\n"
    "  extract IN.log FOLDER   pictures, clouds or poses as files\n"
    "  --help, --version\n";

/// Options of channels, which all commands have.
struct Channels {
  std::string only, without;
  void declare(config::Section& section) {
    section.add("channel", only, "only channels with names like this regular expression");
    section.add("without", without, "no channels with names like this regular expression");
  }
  ChannelFilter filter() const { return ChannelFilter(only, without); }
};

void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw config::cannot_write_to_stdout();
}

void warn_of_losses(std::int64_t torn_bytes, std::int64_t damaged_bytes) {
  if (torn_bytes > 0)
    log(LogLevel::kWarning, "torn: the last " + std::to_string(torn_bytes) +
                                " bytes are no whole event and were left out");
  if (damaged_bytes > 0)
    log(LogLevel::kWarning, "damaged: " + std::to_string(damaged_bytes) +
                                " bytes between events hold no whole event and were left out");
}

void report(const CopySummary& summary, const std::string& out) {
  warn_of_losses(summary.torn_bytes, summary.damaged_bytes);
  log(LogLevel::kInfo, out + ": " + std::to_string(summary.events_kept) + " of " +
                           std::to_string(summary.events_read) + " events");
}

void run_info(int argc, const char* const* argv) {
  std::vector<std::string> paths;
  bool json = false;
  Channels channels;
  config::Section section("log");
  section.add("json", json, "a JSON object for each log instead of the table");
  channels.declare(section);
  config::Parser parser("limbcast-log info", "Says what is in LCM logs.");
  parser.add_positional("LOG...", paths, "logs made by lcm-logger or limbcast");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("log", parser.common().log_level);
  const ChannelFilter filter = channels.filter();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const LogInfo info = read_info(paths[i], filter);
    print((i > 0 && !json ? "\n" : "") + (json ? info_json(info) : info_text(info)));
  }
}

void run_cut(int argc, const char* const* argv) {
  CutOptions options;
  Channels channels;
  config::Section section("log");
  section.add("from-s", options.from_s, "s", "begin this long after the first event; -1: no limit",
              {-1.0, 1e9});
  section.add("to-s", options.to_s, "s", "end this long after the first event; -1: at the end",
              {-1.0, 1e9});
  section.add("from-frame", options.from_frame, "", "first frame, counted from 0", {0, 1000000000});
  section.add("to-frame", options.to_frame, "", "last frame; -1: the last", {-1, 1000000000});
  section.add("keep-calibration", options.keep_calibration,
              "keep each camera's last calibration before the part too");
  channels.declare(section);
  config::Parser parser("limbcast-log cut",
                        "Copies a part of a log; bytes, times, numbers and order stay.");
  parser.add_positional("IN.log", options.in, "log to read");
  parser.add_positional("OUT.log", options.out, "log to write");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("log", parser.common().log_level);
  options.channels = channels.filter();
  lcm_io::install_signal_handlers();
  report(cut(options), options.out);
}

void run_merge(int argc, const char* const* argv) {
  MergeOptions options;
  config::Section section("log");
  section.add("drop-doubles", options.drop_doubles,
              "keep once what several logs hold, because loggers on several hosts heard it");
  config::Parser parser("limbcast-log merge", "Merges logs by the times of their events.");
  parser.add_positional("OUT.log", options.out, "log to write");
  parser.add_positional("IN.log...", options.in, "logs to read");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  // Else OUT.log, forgotten, would be the first of two that are to be merged, and be lost.
  if (options.in.size() < 2)
    throw config::UsageError("command line: " + options.in.front() +
                             " alone gives nothing to merge; give OUT.log and two logs or more");
  config::configure_log("log", parser.common().log_level);
  lcm_io::install_signal_handlers();
  report(merge(options), options.out);
}

Extracted extracted_named(const std::string& name) {
  if (name == "clouds") return Extracted::kClouds;
  if (name == "poses") return Extracted::kPoses;
  return Extracted::kImages;
}

void run_extract(int argc, const char* const* argv) {
  ExtractOptions options;
  std::string what = "images";
  Channels channels;
  config::Section section("log");
  section.add_choice("what", what, {"images", "clouds", "poses"},
                     "pictures with calibration, PCD clouds, or poses as JSON lines");
  section.add("sensor", options.sensor, "only of this sensor; needed where there are several");
  section.add_channel("truth-channel", options.truth_channel, "channel of the truth");
  channels.declare(section);
  config::Parser parser("limbcast-log extract",
                        "Writes a log's frames as a folder that limbcast's sources read.");
  parser.add_positional("IN.log", options.in, "log to read");
  parser.add_positional("FOLDER", options.folder, "folder to write to; made where it is missing");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("log", parser.common().log_level);
  options.what = extracted_named(what);
  options.channels = channels.filter();
  lcm_io::install_signal_handlers();
  const ExtractSummary summary = extract(options);
  warn_of_losses(summary.torn_bytes, summary.damaged_bytes);
  if (summary.malformed > 0)
    log(LogLevel::kWarning, std::to_string(summary.malformed) + " malformed messages left out");
  log(LogLevel::kInfo, options.folder + ": " + std::to_string(summary.frames) + " frames");
}

void run(int argc, const char* const* argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "--help") return print(kUsage);
  if (command == "--version") return print(std::string("limbcast-log ") + config::kVersion + "\n");
  // The command takes the program's place among the arguments.
  if (command == "info") return run_info(argc - 1, argv + 1);
  if (command == "cut") return run_cut(argc - 1, argv + 1);
  if (command == "merge") return run_merge(argc - 1, argv + 1);
  if (command == "extract") return run_extract(argc - 1, argv + 1);
  throw UsageError("command line: " +
                   (command.empty() ? "no command is given" : "'" + command + "' is no command") +
                   "; use info, cut, merge or extract, see limbcast-log --help");
}

}  // namespace
}  // namespace limbcast::logs

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-log", [&] { limbcast::logs::run(argc, argv); });
}
