#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "common/formatted.hpp"
#include "modules/evaluate/report.hpp"

namespace limbcast::evaluate {
namespace {

using Json = nlohmann::ordered_json;

/// What the short line tells.
const std::vector<std::string> kMainFigures = {
    "pointing_right_percent",     "wrong_reported_percent", "pointing_median_deg",
    "joints_within_10cm_percent", "joint_error_mean_cm",    "people_found_percent"};

std::string interval_text(const Figure& figure) {
  if (!figure.interval) return "";
  return formatted("%.1f to %.1f", figure.interval->low, figure.interval->high);
}

std::string value_text(const Figure& figure) {
  if (!figure.value) return "-";
  const bool is_count = !figure.interval;
  return formatted(is_count ? "%.0f" : "%.1f", *figure.value);
}

std::string basis_text(const Figure& figure) {
  const bool is_share = figure.value && figure.key.find("percent") != std::string::npos;
  return (is_share ? formatted("%d of %d ", figure.count, figure.total)
                   : formatted("%d ", figure.total)) +
         figure.total_of;
}

/// "postures right [%]" -> "postures right 98.0 %"
std::string in_words(const Figure& figure) {
  const std::size_t unit_at = figure.title.find(" [");
  if (unit_at == std::string::npos) return figure.title + ' ' + value_text(figure);
  const std::string unit = figure.title.substr(unit_at + 2, figure.title.size() - unit_at - 3);
  return figure.title.substr(0, unit_at) + ' ' + value_text(figure) + ' ' + unit;
}

void write_joints(const Report& report, std::ostream& out) {
  out << formatted("\n%-16s %12s %12s %9s\n", "joint", "within 10 cm", "mean error", "visible");
  for (std::size_t i = 0; i < report.joints_within.size(); ++i) {
    const Figure &within = report.joints_within[i], &error = report.joints_error[i];
    out << formatted("%-16s %10s %% %9s cm %9d\n", within.title.c_str(), value_text(within).c_str(),
                     value_text(error).c_str(), within.total);
  }
}

void write_calibration(const CalibrationTable& table, std::ostream& out) {
  out << '\n' << table.title << '\n';
  for (const CalibrationBand& band : table.bands)
    out << formatted("  stated %8.3f  measured %8.3f  (%d)\n", band.stated, band.measured,
                     band.count);
}

/// What a robot would act on wrongly comes first, then by size.
int gravity_of(const Finding& finding) {
  static const std::vector<std::string> kOrder = {"invented",
                                                  "reported twice",
                                                  "points with the other arm",
                                                  "direction off",
                                                  "direction of a hidden arm off",
                                                  "does not point but is said to",
                                                  "arm is elsewhere than told",
                                                  "not found",
                                                  "points but no direction reported",
                                                  "direction inexact"};
  return static_cast<int>(std::find(kOrder.begin(), kOrder.end(), finding.what) - kOrder.begin());
}

std::vector<Finding> worst_first(std::vector<Finding> findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    const int gravity_a = gravity_of(a), gravity_b = gravity_of(b);
    return gravity_a != gravity_b ? gravity_a < gravity_b : a.figure > b.figure;
  });
  return findings;
}

Json figure_json(const Figure& figure) {
  Json json = {{"value", nullptr}, {"low", nullptr}, {"high", nullptr}};
  if (figure.value) json["value"] = *figure.value;
  if (figure.interval) {
    json["low"] = figure.interval->low;
    json["high"] = figure.interval->high;
  }
  json["count"] = figure.count;
  json["total"] = figure.total;
  json["total_of"] = figure.total_of;
  return json;
}

Json calibration_json(const CalibrationTable& table) {
  Json bands = Json::array();
  for (const CalibrationBand& band : table.bands)
    bands.push_back({{"from", band.from},
                     {"to", band.to},
                     {"count", band.count},
                     {"stated", band.stated},
                     {"measured", band.measured}});
  return bands;
}

Json finding_json(const Finding& finding) {
  return {{"utime", finding.utime},
          {"truth", finding.truth},
          {"report", finding.report},
          {"what", finding.what},
          {"figure", finding.figure}};
}

}  // namespace

std::string report_text(const Report& report, const Tally& tally, int max_findings) {
  std::ostringstream out;
  out << formatted("%d frames with truth, %d of them not reported\n\n", tally.frames,
                   tally.frames_not_reported);
  out << formatted("%-40s %8s %16s  %-26s %s\n", "figure", "value", "95 % interval", "goal", "of");
  for (const Figure& figure : report.figures)
    out << formatted("%-40s %8s %16s  %-26s %s\n", figure.title.c_str(), value_text(figure).c_str(),
                     interval_text(figure).c_str(), figure.goal.c_str(),
                     basis_text(figure).c_str());
  write_joints(report, out);
  for (const CalibrationTable& table : report.calibration) write_calibration(table, out);
  const std::vector<Finding> findings = worst_first(tally.findings);
  const int shown = std::min<int>(max_findings, static_cast<int>(findings.size()));
  if (shown > 0)
    out << "\nworst findings (utime, true person, reported person, what, degrees or metres)\n";
  for (int i = 0; i < shown; ++i) {
    const Finding& finding = findings[static_cast<std::size_t>(i)];
    out << formatted("  %lld %3d %3d  %s %.2f\n", static_cast<long long>(finding.utime),
                     finding.truth, finding.report, finding.what.c_str(), finding.figure);
  }
  return out.str();
}

std::string report_json(const Report& report, const Tally& tally) {
  Json json = {{"frames", tally.frames}, {"frames_not_reported", tally.frames_not_reported}};
  for (const Figure& figure : report.figures) json["figures"][figure.key] = figure_json(figure);
  for (std::size_t i = 0; i < report.joints_within.size(); ++i) {
    const Figure& within = report.joints_within[i];
    json["joints"][within.key] = {{"within_10cm_percent", figure_json(within)},
                                  {"mean_error_cm", figure_json(report.joints_error[i])}};
  }
  json["calibration"] = Json::object();
  for (const CalibrationTable& table : report.calibration)
    json["calibration"][table.key] = calibration_json(table);
  json["findings"] = Json::array();
  for (const Finding& finding : tally.findings) json["findings"].push_back(finding_json(finding));
  return json.dump(1) + "\n";
}

std::string report_line(const Report& report, const Tally& tally) {
  std::string line = formatted("accuracy on %d frames:", tally.frames);
  for (const Figure& figure : report.figures) {
    const bool is_main =
        std::find(kMainFigures.begin(), kMainFigures.end(), figure.key) != kMainFigures.end();
    if (is_main && figure.value) line += ' ' + in_words(figure) + ',';
  }
  line.back() = '\n';
  return line;
}

}  // namespace limbcast::evaluate
