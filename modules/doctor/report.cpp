#include "modules/doctor/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace limbcast::doctor {
namespace {

std::string name_of(Level level) {
  switch (level) {
    case Level::kGood:
      return "good";
    case Level::kNote:
      return "note";
    case Level::kProblem:
      return "problem";
  }
  return "";
}

}  // namespace

bool has_problem(const Findings& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.level == Level::kProblem; });
}

std::string report_text(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    std::string level = name_of(finding.level);
    level.resize(std::string("problem").size(), ' ');
    text += level + "  " + finding.check + ": " + finding.text + "\n";
    if (!finding.command.empty()) text += "         mend: " + finding.command + "\n";
  }
  return text;
}

std::string report_json(const Findings& findings, const Traffic& traffic, const std::string& host,
                        const std::string& url) {
  using nlohmann::ordered_json;
  ordered_json report = {{"host", host},
                         {"url", url},
                         {"good", !has_problem(findings)},
                         {"findings", ordered_json::array()},
                         {"channels", ordered_json::object()}};
  for (const Finding& finding : findings)
    report["findings"].push_back({{"level", name_of(finding.level)},
                                  {"check", finding.check},
                                  {"text", finding.text},
                                  {"command", finding.command}});
  for (const auto& [channel, heard] : traffic.channels) {
    report["channels"][channel] = {
        {"rate_hz", static_cast<double>(heard.messages) / traffic.duration_s},
        {"bytes_per_s", static_cast<double>(heard.bytes) / traffic.duration_s},
        {"largest_bytes", heard.largest}};
  }
  // Texts of other programs may hold any bytes.
  return report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace limbcast::doctor
