#include "modules/doctor/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <tuple>

#include "common/joined.hpp"

namespace limbcast::doctor {
namespace {

constexpr double kMicrosecondsPerMillisecond = 1000.0;
/// Below the period of a camera at 30 frames a second, so that frames keep their order in time.
constexpr double kLargestClockOffset_ms = 20.0;

/// What needs a reconstructor behind it, and what may give clouds itself.
const std::vector<std::string> kCameras = {"stereo_camera", "depth_camera"};
const std::vector<std::string> kSourcesOfClouds = {"laser_scanner", "simulate"};
const std::vector<std::string> kBehindClouds = {"segmenter", "pose_fitter"};
const std::vector<std::string> kChain = {"reconstructor", "segmenter", "pose_fitter"};
/// What works on every frame that it hears.
const std::vector<std::string> kBehindSensors = {"reconstructor", "segmenter", "pose_fitter",
                                                 "tracker"};

/// All of limbcast's that tell how they fare.
const std::vector<std::string> kModules = {"stereo_camera", "depth_camera",  "laser_scanner",
                                           "simulate",      "reconstructor", "segmenter",
                                           "pose_fitter",   "tracker"};

/// "pose_fitter" -> "limbcast-pose-fitter"
std::string unit_of(std::string module) {
  std::replace(module.begin(), module.end(), '_', '-');
  return "limbcast-" + module;
}

std::string fixed(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

/// One running program.
using Process = std::tuple<std::string, std::string, std::int32_t>;  // module, host, pid
struct History {
  ModuleReport first, last;
};

std::map<Process, History> histories(const Traffic& traffic) {
  std::map<Process, History> by_process;
  for (const ModuleReport& report : traffic.reports) {
    const Process process{report.module, report.host, report.pid};
    by_process.try_emplace(process, History{report, report}).first->second.last = report;
  }
  return by_process;
}

Findings check_one(const History& history) {
  const ModuleReport& last = history.last;
  const std::string name = "module " + last.module + " on " + last.host;
  Findings findings;
  if (last.state == "failing")
    findings.push_back({Level::kProblem, name, "fails: " + last.last_error,
                        "journalctl -u " + unit_of(last.module)});
  const std::int64_t lost = last.lost - history.first.lost;
  if (lost > 0)
    findings.push_back({Level::kProblem, name,
                        "lost " + std::to_string(lost) + " frames while listening",
                        "limbcast-doctor  # on " + last.host});
  if (findings.empty()) findings.push_back({Level::kGood, name, last.state, ""});
  return findings;
}

bool heard(const Traffic& traffic, const std::string& module) {
  return std::any_of(traffic.reports.begin(), traffic.reports.end(),
                     [&module](const ModuleReport& report) { return report.module == module; });
}

bool any_heard(const Traffic& traffic, const std::vector<std::string>& modules) {
  return std::any_of(modules.begin(), modules.end(),
                     [&](const std::string& module) { return heard(traffic, module); });
}

Finding missing(const std::string& module) {
  // It may be another project's, which sends the status, too.
  if (std::find(kModules.begin(), kModules.end(), module) == kModules.end())
    return {Level::kProblem, "module " + module,
            "is not heard, and limbcast has none of this name, only " + joined(kModules), ""};
  return {Level::kProblem, "module " + module, "is not heard",
          "systemctl start " + unit_of(module)};
}

Findings check_missing(const Traffic& traffic, const std::vector<std::string>& expected) {
  Findings findings;
  for (const std::string& module : expected)
    if (!heard(traffic, module)) findings.push_back(missing(module));
  return findings;
}

Findings check_chain(const Traffic& traffic) {
  if (traffic.reports.empty())
    return {{Level::kNote, "modules", "none is heard; start them, or check the LCM URL", ""}};
  const bool camera = any_heard(traffic, kCameras);
  const bool clouds = any_heard(traffic, kSourcesOfClouds);
  Findings findings = check_missing(traffic, clouds && !camera ? kBehindClouds : kChain);
  if (!camera && !clouds)
    findings.push_back({Level::kProblem, "modules", "no camera or laser scanner is heard",
                        "systemctl start limbcast-stereo-camera@SENSOR, or by hand "
                        "limbcast-stereo-camera, limbcast-depth-camera or limbcast-laser-scanner"});
  return findings;
}

/// Two of a kind would each work on every frame.
Findings check_doubles(const std::map<Process, History>& processes) {
  std::map<std::string, std::vector<std::string>> hosts;
  for (const auto& [process, history] : processes)
    hosts[std::get<0>(process)].push_back(std::get<1>(process));
  Findings findings;
  for (const std::string& module : kBehindSensors) {
    if (hosts[module].size() < 2) continue;
    std::string where;
    for (const std::string& host : hosts[module]) where += " " + host;
    findings.push_back({Level::kNote, "module " + module,
                        "runs " + std::to_string(hosts[module].size()) + " times:" + where +
                            "; well where their channels differ, else each pose comes doubled",
                        ""});
  }
  return findings;
}

}  // namespace

Findings check_channels(const Traffic& traffic, const KnownChannels& known) {
  Findings findings;
  std::string others;
  std::int64_t other_bytes = 0;
  for (const auto& [channel, heard] : traffic.channels) {
    const auto type = known.find(channel);
    if (type == known.end()) {
      others += " " + channel;
      other_bytes += heard.bytes;
      continue;
    }
    const bool foreign =
        std::any_of(heard.fingerprints.begin(), heard.fingerprints.end(),
                    [&type](std::int64_t fingerprint) { return fingerprint != type->second; });
    if (foreign)
      findings.push_back({Level::kProblem, "channel " + channel,
                          "carries another type: another project's program or another version of "
                          "limbcast sends there",
                          "limbcast-spy  # shows who; then rename one side's channel"});
  }
  if (!others.empty())
    findings.push_back({Level::kNote, "other LCM traffic",
                        fixed(static_cast<double>(other_bytes) / 1e6 / traffic.duration_s, 2) +
                            " MB/s on" + others,
                        ""});
  if (findings.empty() && !traffic.channels.empty())
    findings.push_back({Level::kGood, "channels",
                        std::to_string(traffic.channels.size()) + " heard, each with its type",
                        ""});
  return findings;
}

Findings check_modules(const Traffic& traffic, const std::vector<std::string>& expected) {
  Findings findings;
  const auto processes = histories(traffic);
  for (const auto& [process, history] : processes)
    for (Finding& finding : check_one(history)) findings.push_back(std::move(finding));
  for (Finding& finding : check_doubles(processes)) findings.push_back(std::move(finding));
  for (Finding& finding :
       expected.empty() ? check_chain(traffic) : check_missing(traffic, expected))
    findings.push_back(std::move(finding));
  return findings;
}

Findings check_clocks(const Traffic& traffic, const std::string& this_host) {
  // The message that took the shortest way tells most.
  std::map<std::string, double> offset_ms;
  for (const ModuleReport& report : traffic.reports) {
    if (report.host == this_host) continue;
    const double age_ms = static_cast<double>(report.received_utime - report.sent_utime) /
                          kMicrosecondsPerMillisecond;
    const auto [known, is_new] = offset_ms.try_emplace(report.host, age_ms);
    if (!is_new && std::abs(age_ms) < std::abs(known->second)) known->second = age_ms;
  }
  Findings findings;
  for (const auto& [host, ms] : offset_ms) {
    const std::string name = "clock of " + host;
    const std::string text = fixed(std::abs(ms), 1) + " ms " + (ms > 0.0 ? "behind" : "ahead") +
                             " of this host, the way included";
    if (std::abs(ms) <= kLargestClockOffset_ms)
      findings.push_back({Level::kGood, name, text, ""});
    else
      findings.push_back({Level::kProblem, name, text + "; latencies are wrong",
                          "apt-get install chrony && chronyc makestep  # on both hosts"});
  }
  return findings;
}

std::int64_t largest_message(const Traffic& traffic) {
  std::int64_t largest = 0;
  for (const auto& [channel, heard] : traffic.channels) largest = std::max(largest, heard.largest);
  return largest;
}

}  // namespace limbcast::doctor
