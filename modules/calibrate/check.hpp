#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/calibrate/views.hpp"
#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::calibrate {

struct CheckParams {
  /// Median row difference of matched points after rectification that is still good [px]. A matcher
  /// loses fine texture from about half a pixel on.
  double max_epipolar_px = 0.5;
  /// Difference of a measured length from the known one, as a share: four times what a good
  /// calibration is off by (README), and as much as distances then are.
  double max_length_error = 0.02;
  /// With fewer points nothing is said: their median could rest on wrong matches. More than half a
  /// board of 9 x 6, or what a bare wall does not give.
  int min_points = 30;
};

/// How well a calibration fits the pairs it was given.
struct CheckResult {
  int pairs = 0, board_pairs = 0;
  std::vector<double> row_differences_px;  ///< right minus left, of all matched points
  std::vector<double> length_errors;       ///< of each board's diagonal, as a share

  double median_epipolar_px() const;  ///< of the absolute differences
  double median_shift_px() const;     ///< signed: a drift shows in it
  std::optional<double> median_length_error() const;
};

/// Measures a calibration on pairs: with a board's points where one is seen, else with corners of
/// the scene (reconstructor::row_differences_px).
class CalibrationCheck {
 public:
  CalibrationCheck(StereoCalibration calibration, const Board& board,
                   const CheckParams& params = {});

  /// Throws std::invalid_argument where the images' size is not the calibration's.
  void add(const GreyPair& pair);
  const CheckResult& result() const { return result_; }
  /// Why the calibration is bad; empty: it is good.
  std::vector<std::string> faults() const;

 private:
  bool add_board(const GreyPair& pair);
  void add_features(const GreyPair& pair);

  StereoCalibration calibration_;
  Board board_;
  CheckParams params_;
  CheckResult result_;
  /// Made for the first pair that shows no board: its maps take as long as some pairs.
  std::optional<reconstructor::Rectifier> rectifier_;
};

}  // namespace limbcast::calibrate
