#include "modules/calibrate/view_agreement.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/calib3d.hpp>

#include "common/camera/lens_projection.hpp"
#include "common/formatted.hpp"
#include "common/median.hpp"

namespace limbcast::calibrate {
namespace {

/// What one view says of the pair before the lenses are refined by what both cameras see: where the
/// left image puts the board, in the left camera's frame [sides of a square], and where the right
/// one shows it [px].
struct Sighting {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
};

std::vector<Sighting> sightings_of(const std::vector<View>& views, const Board& board,
                                   const Lens& left) {
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const CommonPoints common = common_points(views[i].left, views[i].right);
    cv::Matx33d R;
    cv::Rodrigues(left.boards[i].rotation, R);
    const cv::Vec3d t(left.boards[i].translation.ptr<double>());
    Sighting sighting;
    for (const cv::Point3f& point : points_of(board, common.ids))
      sighting.points.emplace_back(R * cv::Vec3d(point.x, point.y, point.z) + t);
    sighting.pixels.assign(common.right.begin(), common.right.end());
    sightings.push_back(std::move(sighting));
  }
  return sightings;
}

/// From the left camera to the right one, so that one view puts the board in the same place by both
/// images.
Pose pose_by(const Lenses& lenses, std::size_t view) {
  const Pose& left = lenses.left.boards[view];
  const Pose& right = lenses.right.boards[view];
  cv::Matx33d R;
  cv::Rodrigues(left.rotation, R);
  cv::Mat back_rotation;
  cv::Rodrigues(R.t(), back_rotation);
  const cv::Mat back_translation = -cv::Mat(R.t()) * left.translation;
  Pose pose;
  cv::composeRT(back_rotation, back_translation, right.rotation, right.translation, pose.rotation,
                pose.translation);
  return pose;
}

std::vector<cv::Point2d> pixels_of(const std::vector<cv::Point3d>& points, const Pose& pose,
                                   const Lens& lens) {
  std::vector<cv::Point2d> pixels;
  project_points(points, pose.rotation, pose.translation, lens.calibration, pixels);
  return pixels;
}

/// How the pixels of points change where the board that they are on turns about their middle, about
/// each axis [px / rad], and moves along each [px / side of a square].
Eigen::MatrixXd changes_of(const std::vector<cv::Point3d>& points, const Pose& pose,
                           const Lens& lens, double small_motion) {
  const cv::Point3d middle =
      std::accumulate(points.begin(), points.end(), cv::Point3d()) * (1.0 / points.size());
  const std::vector<cv::Point2d> before = pixels_of(points, pose, lens);
  Eigen::MatrixXd changes(2 * points.size(), 6);
  for (int column = 0; column < changes.cols(); ++column) {
    cv::Vec3d axis;
    axis[column % 3] = small_motion;
    std::vector<cv::Point3d> moved;
    for (const cv::Point3d& point : points)
      moved.push_back(point +
                      (column < 3 ? cv::Point3d(axis).cross(point - middle) : cv::Point3d(axis)));
    const std::vector<cv::Point2d> after = pixels_of(moved, pose, lens);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const cv::Point2d change = (after[i] - before[i]) / small_motion;
      changes(2 * i, column) = change.x;
      changes(2 * i + 1, column) = change.y;
    }
  }
  return changes;
}

/// RMS distance of the points that the right image shows from where the left one puts them, where
/// both images' points are off by 1 px along each axis: more for a board that is small in the
/// image, whose distance is known less well.
double expected_disagreement(const Sighting& sighting, const Lenses& lenses, const Pose& pose,
                             double small_motion) {
  const Eigen::MatrixXd left = changes_of(sighting.points, {}, lenses.left, small_motion);
  const Eigen::MatrixXd right = changes_of(sighting.points, pose, lenses.right, small_motion);
  const Eigen::MatrixXd covariance = (left.transpose() * left).inverse();
  return std::sqrt(2.0 + (right * covariance).cwiseProduct(right).sum() /
                             static_cast<double>(sighting.points.size()));
}

/// RMS distance of the points that the right image shows from where the left one and this pose put
/// them, for each view.
std::vector<double> disagreements_px(const std::vector<Sighting>& sightings, const Lens& right,
                                     const Pose& pose) {
  std::vector<double> errors_px;
  for (const Sighting& sighting : sightings)
    errors_px.push_back(cv::norm(pixels_of(sighting.points, pose, right), sighting.pixels) /
                        std::sqrt(static_cast<double>(sighting.points.size())));
  return errors_px;
}

/// The pose on which most views agree: that of the one view with the least median of disagreements
/// (Rousseeuw 1984), made exact by the half of the views that agrees best with it.
Pose agreed_pose(const std::vector<Sighting>& sightings, const Lenses& lenses,
                 const FitParams& params) {
  Pose pose;
  std::vector<double> errors_px;
  double least_px = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Pose candidate = pose_by(lenses, i);
    const std::vector<double> candidate_px = disagreements_px(sightings, lenses.right, candidate);
    if (median(candidate_px) >= least_px) continue;
    pose = candidate;
    errors_px = candidate_px;
    least_px = median(candidate_px);
  }
  Sighting agreed;
  for (std::size_t i = 0; i < errors_px.size(); ++i) {
    if (errors_px[i] > least_px) continue;
    agreed.points.insert(agreed.points.end(), sightings[i].points.begin(),
                         sightings[i].points.end());
    agreed.pixels.insert(agreed.pixels.end(), sightings[i].pixels.begin(),
                         sightings[i].pixels.end());
  }
  return find_pose(agreed.points, agreed.pixels, lenses.right.calibration, pose, params);
}

}  // namespace

Pose pose_of_pair(const std::vector<View>& views, const Board& board, const Lenses& lenses,
                  const FitParams& params) {
  return agreed_pose(sightings_of(views, board, lenses.left), lenses, params);
}

Outlier most_disagreeing_view(const std::vector<View>& views, const Board& board,
                              const Lenses& lenses, const FitParams& params) {
  const std::vector<Sighting> sightings = sightings_of(views, board, lenses.left);
  const Pose pose = agreed_pose(sightings, lenses, params);
  const std::vector<double> errors_px = disagreements_px(sightings, lenses.right, pose);
  std::vector<double> expected;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < views.size(); ++i) {
    expected.push_back(expected_disagreement(sightings[i], lenses, pose, params.small_motion));
    ratios.push_back(errors_px[i] / expected[i]);
  }
  const double noise_px = median(ratios);
  const double least_limit_px =
      params.outlier_px + 100.0 * params.lens_error_px_per_percent * focal_sigma(lenses);
  Outlier worst;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double limit_px =
        std::max(least_limit_px, params.outlier_factor * noise_px * expected[i]);
    if (errors_px[i] / limit_px <= worst.excess) continue;
    worst = {
        i, errors_px[i] / limit_px,
        formatted("the right image shows the board %.2f px from where the left one and the other "
                  "views put it (limit %.2f): wrong points, or the board moved between the two "
                  "images",
                  errors_px[i], limit_px)};
  }
  return worst;
}

}  // namespace limbcast::calibrate
