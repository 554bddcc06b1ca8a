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

/// Rows by which a pixel moves for each radian of nod and of roll and each pixel of shift.
Eigen::RowVector3d rows_of(double u, double v, const PinholeCamera& camera) {
  const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
  return {camera.fy * (1.0 + y * y), camera.fy * x, 1.0};
}

/// Numbers that most rows agree on.
struct RowFit {
  Eigen::Vector2d numbers;
  double sigma_px = 0.0;  ///< of the rows that they leave unexplained, robust
  double cost = 0.0;  ///< number of rows left unexplained, those that are nearly explained in part
};

/// Least squares, in which what lies far off counts less and less (Geman and McClure 1987).
RowFit fit_rows(const Eigen::MatrixX2d& rows, const Eigen::VectorXd& rows_px) {
  constexpr int kRounds = 10;
  constexpr double kMadToSigma = 1.4826, kLeastSigma_px = 0.03, kLimitSigmas = 2.0;
  constexpr double kUnexplained_px = 0.1;
  std::vector<double> differences_px(rows_px.begin(), rows_px.end());
  // The median row first: of many wrong matches least squares would never come back.
  RowFit fit{{median(differences_px) / rows.col(0).mean(), 0.0}};
  Eigen::ArrayXd left_px = (rows_px - rows * fit.numbers).array();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::ArrayXd sizes_px = left_px.abs();
    std::copy(sizes_px.begin(), sizes_px.end(), differences_px.begin());
    fit.sigma_px = std::max(kMadToSigma * median(differences_px), kLeastSigma_px);
    const Eigen::ArrayXd weights =
        (1.0 + (left_px / (kLimitSigmas * fit.sigma_px)).square()).square().inverse();
    const Eigen::Matrix2Xd weighted = (rows.array().colwise() * weights).matrix().transpose();
    fit.numbers = (weighted * rows).ldlt().solve(weighted * rows_px);
    left_px = (rows_px - rows * fit.numbers).array();
  }
  const Eigen::ArrayXd squares = (left_px / kUnexplained_px).square();
  fit.cost = (squares / (1.0 + squares)).sum();
  return fit;
}

/// The image that the camera would see, were it not turned.
cv::Mat turned_back(const cv::Mat& image, const PinholeCamera& camera, const CameraTurn& turn) {
  const double nod_cos = std::cos(turn.nod_rad), nod_sin = std::sin(turn.nod_rad);
  const double roll_cos = std::cos(turn.roll_rad), roll_sin = std::sin(turn.roll_rad);
  const cv::Matx33d nod(1, 0, 0, 0, nod_cos, nod_sin, 0, -nod_sin, nod_cos);
  const cv::Matx33d roll(roll_cos, -roll_sin, 0, roll_sin, roll_cos, 0, 0, 0, 1);
  const cv::Matx33d pixels(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  // Where the turned camera shows what the straight one would.
  const cv::Matx33d shift(1, 0, 0, 0, 1, turn.shift_px, 0, 0, 1);
  const cv::Matx33d moved = shift * pixels * (roll * nod) * pixels.inv();
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
      track_again(track_corners({shrunk(pair.left, by), shrunk(pair.right, by)}, params.corners),
                  pair, static_cast<float>(by), params.corners.window_px, params.max_move_px);
  if (static_cast<int>(corners.size()) < params.min_corners) return std::nullopt;
  Eigen::MatrixX3d rows(corners.size(), 3);
  Eigen::VectorXd differences_px(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    rows.row(row) = rows_of(corners[i].right.x, corners[i].right.y, camera);
    differences_px[row] = corners[i].right.y - corners[i].left.y;
  }
  // A mount that has bent and a lens that has moved look much alike: which it is, corners far above
  // and below the middle tell. Both at once they hardly do.
  const RowFit bent = fit_rows(rows(Eigen::all, {0, 1}), differences_px);
  const RowFit moved = fit_rows(rows(Eigen::all, {2, 1}), differences_px);
  const bool is_bent = bent.cost <= moved.cost;
  const RowFit& fit = is_bent ? bent : moved;
  if (fit.sigma_px > params.max_sigma_px * by) return std::nullopt;
  CameraTurn turn;
  (is_bent ? turn.nod_rad : turn.shift_px) = fit.numbers[0];
  turn.roll_rad = fit.numbers[1];
  return turn;
}

double row_shift_px(const CameraTurn& turn, const PinholeCamera& camera) {
  constexpr int kPlaces = 8;  // along each side
  double squares_px = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    for (int k = 0; k < kPlaces; ++k) {
      const double shift_px =
          rows_of((i + 0.5) / kPlaces * camera.width, (k + 0.5) / kPlaces * camera.height, camera) *
          Eigen::Vector3d(turn.nod_rad, turn.roll_rad, turn.shift_px);
      squares_px += shift_px * shift_px;
    }
  }
  return std::sqrt(squares_px) / kPlaces;
}

RectifiedPair with_rows_aligned(const RectifiedPair& pair, const PinholeCamera& camera,
                                const RowAlignmentParams& params) {
  const RectifiedPair grey{grey_of(pair.left), grey_of(pair.right)};
  const std::optional<CameraTurn> turn = find_right_turn(grey, camera, params);
  if (!turn || row_shift_px(*turn, camera) < params.min_shift_px) return {pair.left, grey.right};
  return {pair.left, turned_back(grey.right, camera, *turn)};
}

}  // namespace limbcast::reconstructor
