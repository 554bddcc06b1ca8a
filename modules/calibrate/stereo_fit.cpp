#include "modules/calibrate/stereo_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/camera/calibration_checks.hpp"
#include "common/camera/opencv_conversion.hpp"
#include "common/formatted.hpp"
#include "common/joined.hpp"
#include "common/median.hpp"
#include "common/units.hpp"
#include "modules/calibrate/view_agreement.hpp"
#include "modules/reconstructor/rectification.hpp"

namespace limbcast::calibrate {
namespace {

LensCalibration to_calibration(const Lens& lens, const cv::Size& size) {
  LensCalibration calibration;
  const cv::Matx33d K = lens.K;
  calibration.camera = {size.width, size.height, K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
  calibration.distortion.assign(lens.D.begin<double>(), lens.D.end<double>());
  return calibration;
}

double epipolar_rms_px(const CommonPoints& common, const StereoCalibration& calibration) {
  const Rectification& rectification = *calibration.rectification;
  const auto left =
      rectified_points(common.left, calibration.left, rectification.R1, rectification.P1);
  const auto right =
      rectified_points(common.right, calibration.right, rectification.R2, rectification.P2);
  double squares = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i)
    squares += (left[i].y - right[i].y) * (left[i].y - right[i].y);
  return std::sqrt(squares / static_cast<double>(left.size()));
}

void set_pose(const CommonPoints& common, const Board& board, const LensCalibration& lens,
              ViewFit& figures) {
  cv::Vec3d rotation;
  cv::Vec3d translation;
  const std::vector<cv::Point3f> points = points_of(board, common.ids);
  cv::solvePnP(points, common.left, camera_matrix(lens.camera), lens.distortion, rotation,
               translation);
  cv::Matx33d R;
  cv::Rodrigues(rotation, R);
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

double rms_of(const std::vector<ViewFit>& figures, double (*error_px)(const ViewFit&)) {
  double squares = 0.0;
  double count = 0.0;
  for (const ViewFit& view : figures) {
    squares += view.num_points * error_px(view) * error_px(view);
    count += view.num_points;
  }
  return std::sqrt(squares / count);
}

double reprojection_px(const ViewFit& view) {
  return std::hypot(view.reprojection_left_px, view.reprojection_right_px) / std::sqrt(2.0);
}
double epipolar_px(const ViewFit& view) { return view.epipolar_px; }

/// Lenses and pose of the pair, all at once, from the lenses that each camera alone has found.
StereoFit fit_pair(const std::vector<View>& views, const Board& board, const cv::Size& size,
                   const FitParams& params, const Lenses& lenses, Distortion distortion) {
  auto [left, right] = lenses;
  // cv::stereoCalibrate refines them in place.
  for (cv::Mat* refined : {&left.K, &left.D, &right.K, &right.D}) *refined = refined->clone();
  std::vector<CommonPoints> common;
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels_left;
  std::vector<std::vector<cv::Point2f>> pixels_right;
  for (const View& view : views) {
    common.push_back(common_points(view.left, view.right));
    points.push_back(points_of(board, common.back().ids));
    pixels_left.push_back(common.back().left);
    pixels_right.push_back(common.back().right);
  }
  cv::Mat R;
  cv::Mat T;
  cv::Mat view_errors;
  cv::stereoCalibrate(
      points, pixels_left, pixels_right, left.K, left.D, right.K, right.D, size, R, T,
      cv::noArray(), cv::noArray(), view_errors,
      cv::CALIB_USE_INTRINSIC_GUESS | flags_of(distortion),
      {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, params.max_iterations, params.min_change});

  StereoFit fit;
  fit.distortion = distortion;
  fit.calibration.left = to_calibration(left, size);
  fit.calibration.right = to_calibration(right, size);
  cv::cv2eigen(R, fit.calibration.R);
  cv::cv2eigen(T, fit.calibration.T);
  fit.calibration.T *= board.square_m;
  fit.calibration.rectification = reconstructor::compute_rectification(fit.calibration);
  fit.left = left.uncertainty;
  fit.right = right.uncertainty;
  fit.views = views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    ViewFit figures;
    figures.name = views[i].name;
    figures.num_points = static_cast<int>(common[i].ids.size());
    figures.reprojection_left_px = view_errors.at<double>(static_cast<int>(i), 0);
    figures.reprojection_right_px = view_errors.at<double>(static_cast<int>(i), 1);
    figures.epipolar_px = epipolar_rms_px(common[i], fit.calibration);
    set_pose(common[i], board, fit.calibration.left, figures);
    fit.figures.push_back(figures);
  }
  fit.reprojection_px = rms_of(fit.figures, reprojection_px);
  fit.epipolar_px = rms_of(fit.figures, epipolar_px);
  return fit;
}

double median_of(const std::vector<ViewFit>& figures, double (*error_px)(const ViewFit&)) {
  std::vector<double> errors_px;
  for (const ViewFit& view : figures) errors_px.push_back(error_px(view));
  return median(std::move(errors_px));
}

double worst_reprojection_px(const ViewFit& view) {
  return std::max(view.reprojection_left_px, view.reprojection_right_px);
}

Outlier worst_view(const std::vector<ViewFit>& figures, const FitParams& params) {
  struct Kind {
    const char* name;
    double (*error_px)(const ViewFit&);
  };
  Outlier worst;
  for (const Kind& kind :
       {Kind{"reprojection", worst_reprojection_px}, Kind{"epipolar", epipolar_px}}) {
    const double limit_px =
        std::max(params.outlier_px, params.outlier_factor * median_of(figures, kind.error_px));
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const double error_px = kind.error_px(figures[i]);
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

int count_tilted(const std::vector<ViewFit>& figures, double tilt_deg) {
  return static_cast<int>(std::count_if(figures.begin(), figures.end(), [&](const ViewFit& view) {
    return std::hypot(view.tilt_sideways_deg, view.tilt_updown_deg) >= tilt_deg;
  }));
}

void judge_lens(const char* side, const LensCalibration& lens, const LensUncertainty& uncertainty,
                const VerdictParams& params, std::vector<std::string>& faults) {
  const PinholeCamera& camera = lens.camera;
  if (std::abs(camera.fx / camera.fy - 1.0) > params.max_aspect_error)
    faults.push_back(
        formatted("%s camera: focal lengths %.0f and %.0f px differ by more than %.0f %%; "
                  "are the squares of the board square, the pictures not stretched?",
                  side, camera.fx, camera.fy, 100.0 * params.max_aspect_error));
  if (camera.cx < 0.0 || camera.cx >= camera.width || camera.cy < 0.0 || camera.cy >= camera.height)
    faults.push_back(
        formatted("%s camera: the principal point (%.0f, %.0f) is outside the image; add "
                  "views with a tilted board",
                  side, camera.cx, camera.cy));
  if (!(uncertainty.focal_px <= params.max_focal_sigma * camera.fx))
    faults.push_back(
        formatted("%s camera: the focal length %.1f px is known to %.1f px only (limit "
                  "%.0f %%); add views with a tilted board",
                  side, camera.fx, uncertainty.focal_px, 100.0 * params.max_focal_sigma));
  if (const auto fault = distortion_fault(lens))
    faults.push_back(formatted("%s camera: its distortion %s; %s", side, fault->found.c_str(),
                               fault->remedy.c_str()));
}

}  // namespace

std::vector<cv::Point2d> rectified_points(const std::vector<cv::Point2f>& pixels,
                                          const LensCalibration& lens, const Eigen::Matrix3d& R,
                                          const Eigen::Matrix<double, 3, 4>& P) {
  const std::vector<cv::Point2d> exact(pixels.begin(), pixels.end());
  std::vector<cv::Point2d> result;
  cv::undistortPoints(exact, result, camera_matrix(lens.camera), lens.distortion, to_cv(R),
                      to_cv(P));
  return result;
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

/// Without the views that are outliers.
StereoFit fit_without_outliers(const std::vector<View>& views, const Board& board,
                               const cv::Size& image_size, const FitParams& params,
                               Distortion distortion) {
  std::vector<View> kept = views;
  std::vector<RejectedView> outliers;
  while (true) {
    check_enough(kept, outliers, params);
    const Lenses lenses = fit_lenses(kept, board, image_size, distortion);
    Outlier outlier;
    if (focal_sigma(lenses) <= params.known_focal_sigma)
      outlier = most_disagreeing_view(kept, board, lenses, params);
    if (outlier.excess <= 1.0) {
      StereoFit fit = fit_pair(kept, board, image_size, params, lenses, distortion);
      outlier = worst_view(fit.figures, params);
      if (outlier.excess <= 1.0) {
        fit.outliers = std::move(outliers);
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
                     const FitParams& params) {
  const auto fit_with = [&](Distortion distortion) {
    return fit_without_outliers(views, board, image_size, params, distortion);
  };
  const StereoFit fit = fit_with(Distortion::kWithK3);
  if (!folds_an_image(fit)) return fit;
  try {
    const StereoFit stiffer = fit_with(Distortion::kWithoutK3);
    if (!folds_an_image(stiffer)) return stiffer;
  } catch (const std::runtime_error&) {
    // Too few views fit such lenses: those with k3 are told, and why they must not be used.
  }
  return fit;
}

Verdict judge(const StereoFit& fit, double coverage, const VerdictParams& params) {
  Verdict verdict;
  const StereoCalibration& calibration = fit.calibration;
  const int tilted = count_tilted(fit.figures, params.min_tilt_deg);
  if (tilted < params.min_tilted_views)
    verdict.faults.push_back(
        formatted("only %d views show the board tilted by %.0f degrees or more (%d "
                  "are needed): the focal length is a guess",
                  tilted, params.min_tilt_deg, params.min_tilted_views));
  const Eigen::Vector3d& T = calibration.T;
  if (std::abs(T.y()) > std::abs(T.x())) {
    verdict.faults.push_back("one camera stands above the other; mount them side by side");
  } else if (T.x() > 0.0) {
    verdict.faults.push_back("the left camera stands to the right of the right one; swap them");
  }
  if (fit.reprojection_px > params.max_reprojection_px)
    verdict.faults.push_back(
        formatted("the reprojection error is %.2f px (limit %.2f); is the board flat, "
                  "are --columns and --rows right?",
                  fit.reprojection_px, params.max_reprojection_px));
  if (fit.epipolar_px > params.max_epipolar_px)
    verdict.faults.push_back(
        formatted("the epipolar error is %.2f px (limit %.2f); were both images "
                  "taken at the same time?",
                  fit.epipolar_px, params.max_epipolar_px));
  const std::size_t num_outliers = fit.outliers.size();
  const std::size_t num_views = fit.views.size() + num_outliers;
  if (num_outliers > std::max<double>(params.max_outliers,
                                      params.max_outlier_share * static_cast<double>(num_views)))
    verdict.faults.push_back(
        formatted("%zu of %zu views do not fit with the others (limit %.0f %%); were both images "
                  "taken at the same time, the board held still?",
                  num_outliers, num_views, 100.0 * params.max_outlier_share));
  judge_lens("left", calibration.left, fit.left, params, verdict.faults);
  judge_lens("right", calibration.right, fit.right, params, verdict.faults);
  if (coverage < params.min_coverage) {
    verdict.faults.push_back(
        formatted("the boards cover %.0f %% of the image (limit %.0f %%); outside of "
                  "that the distortion is a guess",
                  100.0 * coverage, 100.0 * params.min_coverage));
  } else if (coverage < params.enough_coverage) {
    verdict.warnings.push_back(
        formatted("the boards cover %.0f %% of the image; outside of that depth may be wrong by "
                  "some percent, %.0f %% or more give a better result",
                  100.0 * coverage, 100.0 * params.enough_coverage));
  }
  if (T.norm() < params.min_usual_baseline_m || T.norm() > params.max_usual_baseline_m)
    verdict.warnings.push_back(
        formatted("by this the cameras are %.4g mm apart; is --square-mm in millimetres?",
                  kMillimetersPerMeter<double> * T.norm()));
  if (fit.distortion == Distortion::kWithoutK3)
    verdict.warnings.push_back(
        "the distortion has no k3: with it the image would fold where no board was shown; show it "
        "at the image's borders, too");
  if (static_cast<int>(fit.views.size()) < params.enough_views)
    verdict.warnings.push_back(formatted("only %zu views; %d or more give a better result",
                                         fit.views.size(), params.enough_views));
  return verdict;
}

}  // namespace limbcast::calibrate
