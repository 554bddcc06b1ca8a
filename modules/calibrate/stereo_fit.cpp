#include "modules/calibrate/stereo_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <stdexcept>

#include "common/camera/calibration_checks.hpp"
#include "common/camera/lens_projection.hpp"
#include "common/camera/opencv_conversion.hpp"
#include "common/formatted.hpp"
#include "common/joined.hpp"
#include "common/median.hpp"
#include "common/units.hpp"
#include "modules/calibrate/fisheye_fit.hpp"
#include "modules/calibrate/view_agreement.hpp"
#include "modules/reconstructor/rectification.hpp"

namespace limbcast::calibrate {
namespace {

void set_epipolar_error(const CommonPoints& common, const StereoCalibration& calibration,
                        ViewFit& figures) {
  const RectifiedPoints rectified = rectified_points(common, calibration);
  figures.num_rectified = static_cast<int>(rectified.left.size());
  if (figures.num_rectified == 0) return;
  double squares = 0.0;
  for (std::size_t i = 0; i < rectified.left.size(); ++i) {
    const double difference_px = rectified.left[i].y - rectified.right[i].y;
    squares += difference_px * difference_px;
  }
  figures.epipolar_px = std::sqrt(squares / figures.num_rectified);
}

void set_pose(const CommonPoints& common, const Board& board, const LensCalibration& lens,
              const FitParams& params, ViewFit& figures) {
  const std::vector<cv::Point3f> points = points_of(board, common.ids);
  const Pose pose = find_pose({points.begin(), points.end()},
                              {common.left.begin(), common.left.end()}, lens, {}, params);
  cv::Matx33d R;
  cv::Rodrigues(pose.rotation, R);
  const cv::Vec3d translation(pose.translation.ptr<double>());
  const cv::Point3f middle =
      0.5F * (point_in_squares(board, 0) + point_in_squares(board, board.num_points() - 1));
  figures.distance_m =
      board.square_m * cv::norm(R * cv::Vec3d(middle.x, middle.y, middle.z) + translation);
  // The third column is the board's normal; a board may be numbered so that it points either way.
  const double sign = R(2, 2) < 0.0 ? -1.0 : 1.0;
  figures.tilt_sideways_deg =
      kDegreesPerRadian<double> * std::atan2(sign * R(0, 2), sign * R(2, 2));
  figures.tilt_updown_deg = kDegreesPerRadian<double> * std::atan2(sign * R(1, 2), sign * R(2, 2));
}

/// An error of the views, and how many points show it in each.
struct ErrorKind {
  const char* name;
  double (*px)(const ViewFit&);
  int (*num_points)(const ViewFit&);
};
constexpr ErrorKind kReprojection = {
    "reprojection",
    [](const ViewFit& view) {
      return std::hypot(view.reprojection_left_px, view.reprojection_right_px) / std::sqrt(2.0);
    },
    [](const ViewFit& view) { return view.num_points; }};
constexpr ErrorKind kWorseReprojection = {"reprojection",
                                          [](const ViewFit& view) {
                                            return std::max(view.reprojection_left_px,
                                                            view.reprojection_right_px);
                                          },
                                          [](const ViewFit& view) { return view.num_points; }};
constexpr ErrorKind kEpipolar = {"epipolar", [](const ViewFit& view) { return view.epipolar_px; },
                                 [](const ViewFit& view) { return view.num_rectified; }};

/// Of all points.
double rms_of(const std::vector<ViewFit>& figures, const ErrorKind& kind) {
  double squares = 0.0;
  double count = 0.0;
  for (const ViewFit& view : figures) {
    squares += kind.num_points(view) * kind.px(view) * kind.px(view);
    count += kind.num_points(view);
  }
  return std::sqrt(squares / std::max(1.0, count));
}

/// Pinholes and pose of a pair, all at once, from the lenses that each camera alone has found.
PairFit refine_pinholes(const Lenses& lenses, const SeenPoints& left, const SeenPoints& right,
                        const FitParams& params, Distortion distortion) {
  const auto matrix_of = [](const Lens& lens) {
    return cv::Mat(camera_matrix(lens.calibration.camera));
  };
  const auto coefficients_of = [](const Lens& lens) {
    return cv::Mat(lens.calibration.distortion, true);
  };
  cv::Mat K1 = matrix_of(lenses.left), D1 = coefficients_of(lenses.left);
  cv::Mat K2 = matrix_of(lenses.right), D2 = coefficients_of(lenses.right);
  const PinholeCamera& camera = lenses.left.calibration.camera;
  const cv::Size size(camera.width, camera.height);
  cv::Mat R;
  cv::Mat T;
  cv::Mat view_errors;
  cv::stereoCalibrate(
      left.points, left.pixels, right.pixels, K1, D1, K2, D2, size, R, T, cv::noArray(),
      cv::noArray(), view_errors, cv::CALIB_USE_INTRINSIC_GUESS | flags_of(distortion),
      {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, params.max_iterations, params.min_change});
  PairFit pair{pinhole_of(K1, D1, size), pinhole_of(K2, D2, size), {}, {}, {}};
  cv::cv2eigen(R, pair.R);
  cv::cv2eigen(T, pair.T);
  for (int view = 0; view < view_errors.rows; ++view)
    pair.errors_px.emplace_back(view_errors.at<double>(view, 0), view_errors.at<double>(view, 1));
  return pair;
}

/// Lenses and pose of the pair, all at once, from the lenses that each camera alone has found.
StereoFit fit_pair(const std::vector<View>& views, const Board& board, const FitParams& params,
                   const Lenses& lenses, Distortion distortion) {
  std::vector<CommonPoints> common;
  SeenPoints left;
  SeenPoints right;
  for (const View& view : views) {
    common.push_back(common_points(view.left, view.right));
    left.points.push_back(points_of(board, common.back().ids));
    left.pixels.push_back(common.back().left);
    right.pixels.push_back(common.back().right);
  }
  right.points = left.points;
  const PairFit pair = is_fisheye(distortion)
                           ? refine_fisheyes(lenses, pose_of_pair(views, board, lenses, params),
                                             left, right, distortion, params)
                           : refine_pinholes(lenses, left, right, params, distortion);

  StereoFit fit;
  fit.distortion = distortion;
  fit.calibration.left = pair.left;
  fit.calibration.right = pair.right;
  fit.calibration.R = pair.R;
  fit.calibration.T = board.square_m * pair.T;
  fit.calibration.rectification = reconstructor::compute_rectification(fit.calibration);
  fit.left = lenses.left.uncertainty;
  fit.right = lenses.right.uncertainty;
  fit.views = views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    ViewFit figures;
    figures.name = views[i].name;
    figures.num_points = static_cast<int>(common[i].ids.size());
    figures.reprojection_left_px = pair.errors_px[i][0];
    figures.reprojection_right_px = pair.errors_px[i][1];
    set_epipolar_error(common[i], fit.calibration, figures);
    set_pose(common[i], board, fit.calibration.left, params, figures);
    fit.figures.push_back(figures);
  }
  fit.reprojection_px = rms_of(fit.figures, kReprojection);
  fit.epipolar_px = rms_of(fit.figures, kEpipolar);
  return fit;
}

/// Of the views that show it.
double median_of(const std::vector<ViewFit>& figures, const ErrorKind& kind) {
  std::vector<double> errors_px;
  for (const ViewFit& view : figures) {
    if (kind.num_points(view) > 0) errors_px.push_back(kind.px(view));
  }
  return errors_px.empty() ? 0.0 : median(std::move(errors_px));
}

Outlier worst_view(const std::vector<ViewFit>& figures, const FitParams& params) {
  Outlier worst;
  for (const ErrorKind& kind : {kWorseReprojection, kEpipolar}) {
    const double limit_px =
        std::max(params.outlier_px, params.outlier_factor * median_of(figures, kind));
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const double error_px = kind.px(figures[i]);
      if (error_px / limit_px <= worst.excess) continue;
      worst = {
          i, error_px / limit_px,
          formatted("%s error %.2f px (limit %.2f): wrong points, or the board moved between the "
                    "two images",
                    kind.name, error_px, limit_px)};
    }
  }
  return worst;
}

/// "; the others: the board moves (11), blurred (1)"
std::string text_of(const std::map<std::string, int>& others) {
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : others)
    kinds.push_back(formatted("%s (%d)", kind.c_str(), count));
  return others.empty() ? "" : "; the others: " + joined(kinds);
}

/// Without the points that the rectified images do not show.
RectifiedPoints only_visible(const RectifiedPoints& points, const PinholeCamera& camera) {
  const cv::Rect2d image(0.0, 0.0, camera.width, camera.height);
  RectifiedPoints visible;
  for (std::size_t i = 0; i < points.ids.size(); ++i) {
    if (!image.contains(points.left[i]) || !image.contains(points.right[i])) continue;
    visible.ids.push_back(points.ids[i]);
    visible.left.push_back(points.left[i]);
    visible.right.push_back(points.right[i]);
  }
  return visible;
}

}  // namespace

RectifiedPoints rectified_points(const CommonPoints& common, const StereoCalibration& calibration) {
  const Rectification& rectification = *calibration.rectification;
  const std::vector<cv::Point2d> left(common.left.begin(), common.left.end());
  const std::vector<cv::Point2d> right(common.right.begin(), common.right.end());
  RectifiedPoints result{common.ids, {}, {}};
  undistort_points(left, result.left, calibration.left, to_cv(rectification.R1),
                   to_cv(rectification.P1));
  undistort_points(right, result.right, calibration.right, to_cv(rectification.R2),
                   to_cv(rectification.P2));
  return calibration.left.model == LensModel::kFisheye
             ? only_visible(result, calibration.left.camera)
             : result;
}

void check_enough(const std::vector<View>& views, const std::vector<RejectedView>& rejected,
                  const FitParams& params) {
  if (static_cast<int>(views.size()) >= params.min_views) return;
  std::map<std::string, int> others;
  for (const RejectedView& view : rejected) ++others[view.reason.kind];
  throw std::runtime_error(
      formatted("only %zu good views of the board, at least %d are needed, 15 to 30 are better%s; ",
                views.size(), params.min_views, text_of(others).c_str()) +
      (others.count(kBoardMoves) > 0
           ? "hold it still at each place; of a log of single shots give the folder that "
             "limbcast-log extract writes"
           : "do --board, --columns and --rows describe the board?"));
}

namespace {

/// Without the views and points that are outliers.
StereoFit fit_without_outliers(const std::vector<View>& views, const Board& board,
                               const cv::Size& image_size, const FitParams& params,
                               Distortion distortion) {
  std::vector<View> kept = views;
  std::vector<RejectedView> outliers;
  while (true) {
    check_enough(kept, outliers, params);
    const auto [points, lenses] = fit_good_points(kept, board, image_size, distortion, params);
    Outlier outlier;
    if (focal_sigma(lenses) <= params.known_focal_sigma)
      outlier = most_disagreeing_view(points.views, board, lenses, params);
    if (outlier.excess <= 1.0) {
      StereoFit fit = fit_pair(points.views, board, params, lenses, distortion);
      outlier = worst_view(fit.figures, params);
      if (outlier.excess <= 1.0) {
        fit.outliers = std::move(outliers);
        fit.outlying_points = points.left_out;
        return fit;
      }
    }
    outliers.push_back(
        {kept[outlier.index].name, {"does not fit with the others", outlier.reason}});
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(outlier.index));
  }
}

bool folds_an_image(const StereoFit& fit) {
  return distortion_fault(fit.calibration.left) || distortion_fault(fit.calibration.right);
}

}  // namespace

StereoFit fit_stereo(const std::vector<View>& views, const Board& board, const cv::Size& image_size,
                     LensModel model, const FitParams& params) {
  const bool fisheye = model == LensModel::kFisheye;
  StereoFit fit = fit_without_outliers(views, board, image_size, params,
                                       fisheye ? Distortion::kFisheye : Distortion::kWithK3);
  if (!folds_an_image(fit)) return fit;
  // The same views and points: where the boards are, the lens with all terms fits best, and what
  // one with fewer makes of boards at the image's borders says nothing about them.
  const Distortion without = fisheye ? Distortion::kFisheyeWithoutK3 : Distortion::kWithoutK3;
  StereoFit stiffer = fit_pair(fit.views, board, params,
                               fit_lenses(fit.views, board, image_size, without, params), without);
  if (folds_an_image(stiffer)) return fit;
  stiffer.outliers = std::move(fit.outliers);
  stiffer.outlying_points = std::move(fit.outlying_points);
  return stiffer;
}

}  // namespace limbcast::calibrate
