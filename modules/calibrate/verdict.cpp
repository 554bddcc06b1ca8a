#include "modules/calibrate/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "common/camera/calibration_checks.hpp"
#include "common/formatted.hpp"
#include "common/units.hpp"

namespace limbcast::calibrate {
namespace {

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
  if (!(fit.reprojection_px <= params.max_reprojection_px))
    verdict.faults.push_back(
        formatted("the reprojection error is %.2f px (limit %.2f); is the board flat, "
                  "are --columns and --rows right?",
                  fit.reprojection_px, params.max_reprojection_px));
  const bool shows_boards = std::any_of(fit.figures.begin(), fit.figures.end(),
                                        [](const ViewFit& view) { return view.num_rectified > 0; });
  if (!shows_boards) {
    verdict.faults.push_back(
        "the rectified images show none of the boards, so that their rows are not known to match; "
        "show it in the middle of both images, too");
  } else if (!(fit.epipolar_px <= params.max_epipolar_px)) {
    verdict.faults.push_back(
        formatted("the epipolar error is %.2f px (limit %.2f); were both images "
                  "taken at the same time?",
                  fit.epipolar_px, params.max_epipolar_px));
  }
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
  const bool lacks_k4 = fit.distortion == Distortion::kFisheyeWithoutK3;
  if (lacks_k4 || fit.distortion == Distortion::kWithoutK3)
    verdict.warnings.push_back(
        formatted("the distortion has no %s the image would fold where no board was shown; show it "
                  "at the image's borders, too",
                  lacks_k4 ? "k3 and k4: with them" : "k3: with it"));
  if (static_cast<int>(fit.views.size()) < params.enough_views)
    verdict.warnings.push_back(formatted("only %zu views; %d or more give a better result",
                                         fit.views.size(), params.enough_views));
  return verdict;
}

}  // namespace limbcast::calibrate
