#include "modules/reconstructor/row_alignment.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "common/median.hpp"
#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {
namespace {

RectifiedPair shrunk(const RectifiedPair& pair, int by) {
  if (by <= 1) return pair;
  RectifiedPair small;
  cv::resize(pair.left, small.left, {}, 1.0 / by, 1.0 / by, cv::INTER_AREA);
  cv::resize(pair.right, small.right, {}, 1.0 / by, 1.0 / by, cv::INTER_AREA);
  return small;
}

/// Rows by which a pixel moves for each radian of nod and of roll.
Eigen::RowVector2d rows_per_radian(double u, double v, const PinholeCamera& camera) {
  const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
  return {camera.fy * (1.0 + y * y), camera.fy * x};
}

struct FittedTurn {
  CameraTurn turn;
  double sigma_px = 0.0;  ///< of the rows that it leaves unexplained, robust
};

/// The turn that most of the row differences agree on: least squares, in which what lies far off
/// counts less and less (Geman and McClure 1987).
FittedTurn fit_turn(const Eigen::MatrixX2d& rows_per_radian, const Eigen::VectorXd& rows_px) {
  constexpr int kRounds = 10;
  constexpr double kMadToSigma = 1.4826, kLeastSigma_px = 0.03, kLimitSigmas = 2.0;
  std::vector<double> differences_px(rows_px.begin(), rows_px.end());
  // The median row first: of many wrong matches least squares would never come back.
  Eigen::Vector2d turn{median(differences_px) / rows_per_radian.col(0).mean(), 0.0};
  double sigma_px = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::ArrayXd left_px = (rows_px - rows_per_radian * turn).array();
    const Eigen::ArrayXd sizes_px = left_px.abs();
    std::copy(sizes_px.begin(), sizes_px.end(), differences_px.begin());
    sigma_px = std::max(kMadToSigma * median(differences_px), kLeastSigma_px);
    const Eigen::ArrayXd weights =
        (1.0 + (left_px / (kLimitSigmas * sigma_px)).square()).square().inverse();
    const Eigen::Matrix2Xd weighted =
        (rows_per_radian.array().colwise() * weights).matrix().transpose();
    turn = (weighted * rows_per_radian).ldlt().solve(weighted * rows_px);
  }
  return {{turn[0], turn[1]}, sigma_px};
}

/// The image that the camera would see, were it not turned.
cv::Mat turned_back(const cv::Mat& image, const PinholeCamera& camera, const CameraTurn& turn) {
  const double nod_cos = std::cos(turn.nod_rad), nod_sin = std::sin(turn.nod_rad);
  const double roll_cos = std::cos(turn.roll_rad), roll_sin = std::sin(turn.roll_rad);
  const cv::Matx33d nod(1, 0, 0, 0, nod_cos, nod_sin, 0, -nod_sin, nod_cos);
  const cv::Matx33d roll(roll_cos, -roll_sin, 0, roll_sin, roll_cos, 0, 0, 0, 1);
  const cv::Matx33d pixels(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  // Where the turned camera shows what the straight one would.
  const cv::Matx33d moved = pixels * (roll * nod) * pixels.inv();
  cv::Mat result;
  cv::warpPerspective(image, result, moved, image.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  return result;
}

}  // namespace

std::optional<CameraTurn> find_right_turn(const RectifiedPair& pair, const PinholeCamera& camera,
                                          const RowAlignmentParams& params) {
  const int by = std::max(1, pair.left.cols / params.search_width_px);
  const std::vector<CornerTrack> corners =
      track_again(track_corners(shrunk(pair, by), params.corners), pair, static_cast<float>(by),
                  params.corners.window_px, params.max_move_px);
  if (static_cast<int>(corners.size()) < params.min_corners) return std::nullopt;
  Eigen::MatrixX2d rows(corners.size(), 2);
  Eigen::VectorXd differences_px(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    rows.row(row) = rows_per_radian(corners[i].right.x, corners[i].right.y, camera);
    differences_px[row] = corners[i].right.y - corners[i].left.y;
  }
  const FittedTurn fitted = fit_turn(rows, differences_px);
  if (fitted.sigma_px > params.max_sigma_px * by) return std::nullopt;
  return fitted.turn;
}

double row_shift_px(const CameraTurn& turn, const PinholeCamera& camera) {
  constexpr int kPlaces = 8;  // along each side
  double squares_px = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int k = 0; k < kPlaces; ++k) {
      const double shift_px = rows_per_radian((i + 0.5) / kPlaces * camera.width,
                                              (k + 0.5) / kPlaces * camera.height, camera) *
                              Eigen::Vector2d(turn.nod_rad, turn.roll_rad);
      squares_px += shift_px * shift_px;
    }
  }
  return std::sqrt(squares_px) / kPlaces;
}

RectifiedPair with_rows_aligned(const RectifiedPair& pair, const PinholeCamera& camera,
                                const RowAlignmentParams& params) {
  const RectifiedPair grey{grey_of(pair.left), grey_of(pair.right)};
  const std::optional<CameraTurn> turn = find_right_turn(grey, camera, params);
  if (!turn || row_shift_px(*turn, camera) < params.min_shift_px) return pair;
  return {pair.left, turned_back(grey.right, camera, *turn)};
}

}  // namespace limbcast::reconstructor
