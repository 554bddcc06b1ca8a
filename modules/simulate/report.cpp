#include "modules/simulate/report.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/simulate/frame_messages.hpp"

extern char** environ;

namespace limbcast::simulate {
namespace {

namespace fs = std::filesystem;

/// A folder that goes when it is no longer needed.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const char* told = std::getenv("TMPDIR");
    const std::string place = told != nullptr && *told != '\0' ? told : "/tmp";
    std::string name = fs::path(place) / "limbcast_report_XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw config::UsageError(place + ": no temporary folder can be made there (" +
                               std::strerror(errno) + "); set TMPDIR to another");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Waits for its end, which comes soon where this program is told to end.
int status_at_end_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR)
    if (lcm_io::stop_requested()) kill(process, SIGTERM);
  return status;
}

/// Runs a program, what it says goes to `said`. Is it done? Not where this one was told to end.
bool run(const std::vector<std::string>& command, const std::string& said) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int failed =
      posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw std::runtime_error(command[0] +
                             ": cannot be started; is it installed beside this program?");
  const int status = status_at_end_of(process);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  if (lcm_io::stop_requested()) return false;
  std::ifstream file(said);
  std::string line;
  std::string last;
  while (std::getline(file, line)) last = line;
  throw std::runtime_error(command[0] + " failed: " + last);
}

std::optional<double> figure(const nlohmann::json& evaluation, const char* name) {
  const auto& figures = evaluation.at("figures");
  if (!figures.contains(name) || figures.at(name).at("value").is_null()) return std::nullopt;
  return figures.at(name).at("value").get<double>();
}

SimulatorParams at_distance(SimulatorParams params, double distance_m) {
  ScenarioParams& scenario = params.scenario;
  scenario.set = SetKind::kPointing;
  scenario.min_distance_m = distance_m - 0.1;
  scenario.max_distance_m = distance_m + 0.1;
  scenario.occluder_share = 0.0;
  scenario.cut_share = 1.0;  // near the camera nobody fits in whole: that is part of the answer
  params.vary_noise = false;
  return params;
}

ReportRow simulate_row(const SimulatorParams& params, const ReportParams& report, double distance_m,
                       const std::string& log_path, std::uint64_t seed) {
  ReportRow row;
  row.distance_m = distance_m;
  row.sigma_z_m = sigma_z_m(params, distance_m);
  lcm_io::LogWriter log(log_path);
  Outlet outlet(log);
  for (int i = 0; i < report.frames && !lcm_io::stop_requested(); ++i) {
    const SimulatedFrame frame = simulate_frame(params, seed, i);
    for (const int points : frame.pixels)
      row.points_on_person += static_cast<double>(points) / report.frames;
    FrameMessages(params, frame, "simulated", i).send({}, outlet);
  }
  log.close();
  return row;
}

/// Runs the chain on the frames of a row. False where the program was told to end meanwhile.
bool measure(const std::string& programs, const TemporaryFolder& folder, ReportRow& row) {
  const std::string said = folder.file("said.txt"), figures = folder.file("figures.json");
  const bool done =
      run({programs + "/limbcast-replay", folder.file("in.log"), folder.file("out.log")}, said) &&
      run({programs + "/limbcast-evaluate", folder.file("out.log"), "--json", figures}, said);
  if (!done) return false;
  nlohmann::json evaluation;
  std::ifstream(figures) >> evaluation;
  row.found_percent = figure(evaluation, "people_found_percent");
  row.joints_percent = figure(evaluation, "joints_within_10cm_percent");
  row.joint_error_cm = figure(evaluation, "joint_error_mean_cm");
  row.right_percent = figure(evaluation, "pointing_right_percent");
  row.pointing_deg = figure(evaluation, "pointing_median_deg");
  return true;
}

std::string text_of(const std::optional<double>& value) {
  if (!value) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f", *value);
  return text;
}

/// Distances one after the other at which poses are right.
struct Stretch {
  int rows = 0;
  double from_m = 0.0, to_m = 0.0;
};

/// A distance beyond one at which poses are wrong does not count as reached.
Stretch longest_stretch(const std::vector<ReportRow>& rows, double right_share) {
  Stretch longest;
  Stretch current;
  for (const ReportRow& row : rows) {
    if (!row.joints_percent || *row.joints_percent < 100.0 * right_share) {
      current = {};
      continue;
    }
    if (current.rows == 0) current.from_m = row.distance_m;
    current.to_m = row.distance_m;
    ++current.rows;
    if (current.rows > longest.rows) longest = current;
  }
  return longest;
}

}  // namespace

double sigma_z_m(const SimulatorParams& params, double distance_m) {
  switch (params.sensor) {
    case SensorKind::kStereo:
    case SensorKind::kStereoDepth:
      return distance_m * distance_m * params.stereo.sigma_px /
             (params.camera.fx * params.baseline_m);
    case SensorKind::kDepth: {
      const double beyond = distance_m - 0.4;
      return params.depth.constant_sigma_m + params.depth.quadratic_sigma_per_m * beyond * beyond;
    }
    case SensorKind::kLaser:
      return std::hypot(params.laser.range_sigma_m, params.laser.ring_range_sigma_m);
  }
  return 0.0;
}

std::vector<double> distances_m(const ReportParams& report) {
  std::vector<double> distances;
  for (double distance = report.from_m; distance < report.to_m + 1e-6; distance += report.step_m)
    distances.push_back(distance);
  return distances;
}

std::vector<ReportRow> make_report(const SimulatorParams& params, const ReportParams& report,
                                   const std::string& programs, std::uint64_t seed) {
  const TemporaryFolder folder;
  std::vector<ReportRow> rows;
  for (const double distance : distances_m(report)) {
    const SimulatorParams here = at_distance(params, distance);
    ReportRow row = simulate_row(here, report, distance, folder.file("in.log"), seed);
    if (lcm_io::stop_requested() || !measure(programs, folder, row)) break;
    rows.push_back(row);
    char text[64];
    std::snprintf(text, sizeof(text), "%.1f m done", distance);
    config::log(config::LogLevel::kInfo, text);
  }
  return rows;
}

void print_report(const std::vector<ReportRow>& rows, const ReportParams& report,
                  std::ostream& out) {
  out << "distance  sigma of distance  points on person  people found  joints within 10 cm  mean "
         "error  postures right"
         "  pointing median\n";
  for (const ReportRow& row : rows) {
    char text[200];
    std::snprintf(text, sizeof(text),
                  "%6.1f m %14.1f cm %16.0f %12s %% %18s %% %8s cm %13s %% %12s deg\n",
                  row.distance_m, 100.0 * row.sigma_z_m, row.points_on_person,
                  text_of(row.found_percent).c_str(), text_of(row.joints_percent).c_str(),
                  text_of(row.joint_error_cm).c_str(), text_of(row.right_percent).c_str(),
                  text_of(row.pointing_deg).c_str());
    out << text;
  }
  const Stretch stretch = longest_stretch(rows, report.right_share);
  char text[160];
  if (stretch.rows > 0) {
    std::snprintf(
        text, sizeof(text),
        "Poses are right (%.0f %% of the visible joints within 10 cm) from %.1f to %.1f m.\n",
        100.0 * report.right_share, stretch.from_m, stretch.to_m);
  } else {
    std::snprintf(text, sizeof(text),
                  "Poses are right (%.0f %% of the visible joints within 10 cm) at no distance.\n",
                  100.0 * report.right_share);
  }
  out << text;
}

}  // namespace limbcast::simulate
