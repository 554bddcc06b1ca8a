#include "modules/calibrate/check.hpp"

#include <cmath>

#include "common/formatted.hpp"
#include "common/median.hpp"
#include "modules/calibrate/stereo_fit.hpp"
#include "modules/reconstructor/rectification.hpp"
#include "modules/reconstructor/row_differences.hpp"

namespace limbcast::calibrate {
namespace {

/// Point seen at `left` and `right` in the rectified images [m].
cv::Point3d triangulate(const cv::Point2d& left, const cv::Point2d& right,
                        const Rectification& rectification) {
  const double focal_px = rectification.P1(0, 0);
  const double cx_left = rectification.P1(0, 2);
  const double disparity_px = (left.x - cx_left) - (right.x - rectification.P2(0, 2));
  const double z_m = -rectification.P2(0, 3) / disparity_px;
  return {(left.x - cx_left) * z_m / focal_px, (left.y - rectification.P1(1, 2)) * z_m / focal_px,
          z_m};
}

}  // namespace

double CheckResult::median_epipolar_px() const {
  return row_differences_px.empty() ? 0.0 : reconstructor::median_size_px(row_differences_px);
}

double CheckResult::median_shift_px() const {
  return row_differences_px.empty() ? 0.0 : median(row_differences_px);
}

std::optional<double> CheckResult::median_length_error() const {
  if (length_errors.empty()) return std::nullopt;
  return median(length_errors);
}

CalibrationCheck::CalibrationCheck(StereoCalibration calibration, const Board& board,
                                   const CheckParams& params)
    : calibration_(std::move(calibration)), board_(board), params_(params) {
  if (!calibration_.rectification)
    calibration_.rectification = reconstructor::compute_rectification(calibration_);
}

void CalibrationCheck::add(const GreyPair& pair) {
  ++result_.pairs;
  if (!add_board(pair)) add_features(pair);
}

/// False: both images do not show the board.
bool CalibrationCheck::add_board(const GreyPair& pair) {
  const std::optional<BoardPoints> seen_left = find_board(pair.left, board_);
  if (!seen_left) return false;
  std::optional<BoardPoints> seen_right = find_board(pair.right, board_);
  if (!seen_right) return false;
  align_numbering(board_, *seen_left, *seen_right);
  const CommonPoints common = common_points(*seen_left, *seen_right);
  const RectifiedPoints rectified = rectified_points(common, calibration_);
  if (rectified.ids.size() < 2) return false;
  const auto& [ids, left, right] = rectified;
  for (std::size_t i = 0; i < left.size(); ++i)
    result_.row_differences_px.push_back(right[i].y - left[i].y);
  const Rectification& rectification = *calibration_.rectification;
  const double measured_m = cv::norm(triangulate(left.back(), right.back(), rectification) -
                                     triangulate(left.front(), right.front(), rectification));
  const double known_m = cv::norm(board_.point_m(ids.back()) - board_.point_m(ids.front()));
  result_.length_errors.push_back(measured_m / known_m - 1.0);
  ++result_.board_pairs;
  return true;
}

void CalibrationCheck::add_features(const GreyPair& pair) {
  if (!rectifier_) rectifier_.emplace(calibration_);
  const std::vector<double> differences_px =
      reconstructor::row_differences_px(rectifier_->rectify(pair.left, pair.right));
  result_.row_differences_px.insert(result_.row_differences_px.end(), differences_px.begin(),
                                    differences_px.end());
}

std::vector<std::string> CalibrationCheck::faults() const {
  if (static_cast<int>(result_.row_differences_px.size()) < params_.min_points)
    return {
        formatted("only %zu matched points, %d are needed: show a board or a scene with texture",
                  result_.row_differences_px.size(), params_.min_points)};
  std::vector<std::string> faults;
  if (!(result_.median_epipolar_px() <= params_.max_epipolar_px))
    faults.push_back(formatted("the median epipolar error is %.2f px (limit %.2f); calibrate again",
                               result_.median_epipolar_px(), params_.max_epipolar_px));
  const std::optional<double> length_error = result_.median_length_error();
  if (length_error && !(std::abs(*length_error) <= params_.max_length_error))
    faults.push_back(
        formatted("lengths on the board are off by %+.1f %% (limit %.0f %%); is --square-mm "
                  "right? Else calibrate again",
                  100.0 * *length_error, 100.0 * params_.max_length_error));
  return faults;
}

}  // namespace limbcast::calibrate
