#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/evaluate/evaluation.hpp"
#include "modules/evaluate/statistics.hpp"

namespace limbcast::evaluate {

/// One line of the table.
struct Figure {
  std::string key;                   ///< in JSON, e.g. "pointing_right_percent"
  std::string title;                 ///< in the text, with the unit
  std::optional<double> value;       ///< nothing where nothing was measured
  std::optional<Interval> interval;  ///< 95 %
  int count = 0;                     ///< events, or 0 where `value` is no share
  int total = 0;         ///< out of; number of measured values where `value` is no share
  std::string total_of;  ///< what `total` counts
  std::string goal;      ///< DESIGN "What counts", "" where it names none
};

/// How well stated certainties hold in one band of them.
struct CalibrationBand {
  double from = 0.0, to = 0.0;
  int count = 0;
  double stated = 0.0, measured = 0.0;  ///< mean stated and what was measured
};

/// Bands of stated probability with the share that came true.
std::vector<CalibrationBand> probability_bands(const std::vector<Stated>& values,
                                               const std::vector<double>& limits);
/// Bands of stated standard deviation with the root mean square of the errors; `limits` in their
/// unit.
std::vector<CalibrationBand> sigma_bands(const std::vector<Stated>& values,
                                         const std::vector<double>& limits);

struct CalibrationTable {
  std::string key, title;
  std::vector<CalibrationBand> bands;
};

/// All that evaluate tells, computed once for text, JSON and picture.
struct Report {
  std::vector<Figure> figures;
  std::vector<Figure> joints_within;          ///< one for each joint
  std::vector<Figure> joints_error;           ///< mean error, one for each joint
  std::vector<CalibrationTable> calibration;  ///< those that were stated
};

Report make_report(const Tally& tally);

/// The table for people; `max_findings`: so many of the worst findings below it.
std::string report_text(const Report& report, const Tally& tally, int max_findings);
/// The table for programs, indented.
std::string report_json(const Report& report, const Tally& tally);
/// The main figures in one line.
std::string report_line(const Report& report, const Tally& tally);

}  // namespace limbcast::evaluate
