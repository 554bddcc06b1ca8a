#include <cstdio>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/camera/picture_file.hpp"
#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/pose_log.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "common/whole_file.hpp"
#include "modules/evaluate/picture.hpp"
#include "modules/evaluate/report.hpp"
#include "modules/evaluate/tracking.hpp"
#include "modules/evaluate/truth_folder.hpp"

namespace limbcast::evaluate {
namespace {

using config::UsageError;

struct Options {
  std::string log, poses, truth, bodies, json, picture;
  std::string channel = "BODY_POSES", tracked_channel = "TRACKED_POSES";
  std::string truth_channel = "GROUND_TRUTH";
  int worst = 0;
  bool brief = false;
};

void declare(config::Section& section, Options& options) {
  section.add("poses", options.poses,
              "poses that limbcast-export-poses wrote (JSON lines); needs --truth");
  section.add("truth", options.truth,
              "folders with NAME_gt.json, separated by commas; default: the truth in the log");
  section.add("bodies", options.bodies,
              "count only persons whose body begins so, e.g. D4,D5 (needs --truth); default: all");
  section.add_name("json", options.json, "file to write all figures to as JSON");
  section.add_name("picture", options.picture,
                   "file to draw the distribution of the errors to, .png or .jpg");
  section.add_channel("channel", options.channel, "channel of the poses in the log");
  section.add_channel("tracked-channel", options.tracked_channel,
                      "channel of the tracked poses in the log, to compare with the poses");
  section.add_channel("truth-channel", options.truth_channel, "channel of the truth in the log");
  section.add("brief", options.brief, "print the main figures in one line instead of the table");
  section.add("worst", options.worst, "", "list so many of the worst findings", {0, 1000000});
}

void check(const Options& options) {
  if (options.log.empty() == options.poses.empty())
    throw UsageError("give either a log or --poses FILE; see limbcast-evaluate --help");
  if (!options.poses.empty() && options.truth.empty())
    throw UsageError("--poses needs --truth DIR: exported poses carry no truth");
  if (!options.bodies.empty() && options.truth.empty())
    throw UsageError("--bodies needs --truth DIR: a log's truth does not name the bodies");
  std::vector<std::string> inputs = truth_files(split_list(options.truth));
  inputs.insert(inputs.end(), {options.log, options.poses});
  config::check_output_file("--json", options.json, inputs);
  config::check_output_file("--picture", options.picture, inputs);
  config::check_outputs_differ("--picture", options.picture, "--json", options.json);
  check_picture_ending(options.picture);
}

/// Poses of one channel of a log.
struct ReadPoses {
  std::vector<BodyPoses> frames;
  lcm_io::PoseLogSummary summary;
};

ReadPoses read_log(const Options& options, const std::string& channel) {
  ReadPoses read;
  read.summary = lcm_io::visit_poses(options.log, channel,
                                     [&](const BodyPoses& poses) { read.frames.push_back(poses); });
  // The log is read once for each channel, and is torn but once.
  if (channel != options.channel) read.summary.torn_bytes = 0;
  lcm_io::warn_about(read.summary, options.log, channel);
  return read;
}

std::vector<BodyPoses> read_reported(const Options& options) {
  if (!options.poses.empty()) return pose_json::read_file(options.poses);
  ReadPoses read = read_log(options, options.channel);
  if (read.frames.empty())
    throw UsageError(
        lcm_io::no_poses_on(options.channel, options.log, read.summary.other_channels));
  return std::move(read.frames);
}

std::vector<TruthFrame> read_truth(const Options& options) {
  if (!options.truth.empty())
    return read_truth_folders(split_list(options.truth), split_list(options.bodies));
  std::vector<TruthFrame> frames;
  std::set<std::pair<std::string, std::int64_t>> read;
  for (BodyPoses& poses : read_log(options, options.truth_channel).frames) {
    const bool is_new = read.emplace(poses.stamp.sensor, poses.stamp.utime).second;
    if (is_new) frames.push_back({std::move(poses), {}});  // else heard by two loggers
  }
  if (frames.empty())
    throw UsageError(options.log + ": carries no truth on " + options.truth_channel +
                     "; give the folder of the truth with --truth");
  return frames;
}

/// Figures of tracking, where the log holds tracked poses.
std::vector<Figure> compare_tracked(const Options& options, const std::vector<TruthFrame>& truth,
                                    const std::vector<BodyPoses>& reported) {
  if (options.log.empty() || options.channel == options.tracked_channel) return {};
  const std::vector<BodyPoses> tracked = read_log(options, options.tracked_channel).frames;
  if (tracked.empty()) return {};
  return tracking_figures(evaluate_tracking(truth, reported, tracked));
}

/// A full disk must not pass for a report.
void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw config::cannot_write_to_stdout();
}

void run(int argc, const char* const* argv) {
  Options options;
  config::Section section("evaluate");
  declare(section, options);
  config::Parser parser("limbcast-evaluate", "Compares poses with the truth.");
  parser.add_positional("[OUT.log]", options.log,
                        "log that holds poses and truth (limbcast-replay)");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("evaluate", parser.common().log_level);
  check(options);

  const std::vector<BodyPoses> reported = read_reported(options);
  const std::vector<TruthFrame> truth = read_truth(options);
  const Tally tally = evaluate(truth, reported);
  if (tally.frames == tally.frames_not_reported)
    config::log(config::LogLevel::kWarning,
                "no frame with truth was reported: do poses and truth belong together?");
  Report report = make_report(tally);
  const std::vector<Figure> tracking = compare_tracked(options, truth, reported);
  report.figures.insert(report.figures.end(), tracking.begin(), tracking.end());
  print(options.brief ? report_line(report, tally) : report_text(report, tally, options.worst));
  if (!options.json.empty()) write_whole_file(options.json, report_json(report, tally));
  if (!options.picture.empty()) write_picture(options.picture, draw_error_distribution(tally));
}

}  // namespace
}  // namespace limbcast::evaluate

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-evaluate",
                                       [&] { limbcast::evaluate::run(argc, argv); });
}
