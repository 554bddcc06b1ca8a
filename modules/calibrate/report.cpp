#include "modules/calibrate/report.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/formatted.hpp"
#include "common/units.hpp"
#include "modules/calibrate/coverage.hpp"

namespace limbcast::calibrate {
namespace {

std::string lens_line(const char* side, const LensCalibration& lens,
                      const LensUncertainty& uncertainty, double covered) {
  return formatted(
      "%-5s  focal length %.1f x %.1f px (sigma %.2f), principal point %.1f, %.1f (sigma "
      "%.2f); boards cover %.0f %% of the image\n",
      side, lens.camera.fx, lens.camera.fy, uncertainty.focal_px, lens.camera.cx, lens.camera.cy,
      uncertainty.principal_point_px, 100.0 * covered);
}

}  // namespace

std::string view_table(const std::vector<ViewFit>& figures) {
  std::string table =
      "view                  points  reprojection left  right  epipolar [px]  distance [m]  tilt "
      "sideways  up/down [deg]\n";
  for (const ViewFit& view : figures) {
    const std::string epipolar = view.num_rectified > 0 ? formatted("%.2f", view.epipolar_px) : "-";
    table +=
        formatted("%-20s  %6d  %17.2f  %5.2f  %13s  %12.2f  %13.0f  %13.0f\n", view.name.c_str(),
                  view.num_points, view.reprojection_left_px, view.reprojection_right_px,
                  epipolar.c_str(), view.distance_m, view.tilt_sideways_deg, view.tilt_updown_deg);
  }
  return table;
}

std::string rejected_table(const std::vector<RejectedView>& rejected) {
  std::string table;
  for (const RejectedView& view : rejected)
    table += formatted("%-20s  rejected: %s\n", view.name.c_str(), view.reason.text.c_str());
  return table;
}

std::string left_out_table(const std::vector<OutlyingPoint>& left_out) {
  std::map<std::pair<std::string, Side>, std::vector<double>> errors_px;
  for (const OutlyingPoint& point : left_out)
    errors_px[{point.view, point.side}].push_back(point.error_px);
  std::string table;
  for (const auto& [image, errors] : errors_px)
    table += formatted(
        "%-20s  left out: %zu of the %s image's points, up to %.1f px from where the others put "
        "it\n",
        image.first.c_str(), errors.size(), image.second == Side::kLeft ? "left" : "right",
        *std::max_element(errors.begin(), errors.end()));
  return table;
}

std::string summary_text(const StereoFit& fit, const SeenAreas& seen) {
  const StereoCalibration& calibration = fit.calibration;
  const std::string left_out =
      fit.outlying_points.empty()
          ? ""
          : formatted(" without %zu points that were left out", fit.outlying_points.size());
  return formatted("%zu views%s: reprojection error %.2f px, epipolar error %.2f px (RMS)\n",
                   fit.views.size(), left_out.c_str(), fit.reprojection_px, fit.epipolar_px) +
         lens_line("left", calibration.left, fit.left, coverage(fit.views, Side::kLeft, seen)) +
         lens_line("right", calibration.right, fit.right, coverage(fit.views, Side::kRight, seen)) +
         formatted("baseline %.2f mm\n", kMillimetersPerMeter<double> * calibration.T.norm());
}

}  // namespace limbcast::calibrate
