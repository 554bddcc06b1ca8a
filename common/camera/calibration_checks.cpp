#include "common/camera/calibration_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/formatted.hpp"
#include "common/units.hpp"

namespace limbcast {
namespace {

/// Above this a baseline is taken for one in millimetres or board squares [m]. No stereo head for
/// people has one.
constexpr double kLargestBaseline_m = 5.0;
/// Below this nothing has a depth: a baseline that is not in metres, or none [m].
constexpr double kSmallestBaseline_m = 0.002;
/// Cameras of a pair look the same way, or hardly see the same; more is a mistaken sign or axis.
constexpr double kLargestTurn_deg = 60.0;
/// Lenses of a pair are alike; more is a wrong unit or another camera's calibration.
constexpr double kLargestFocalRatio = 2.0;
/// Rounding of a camera matrix [share of the focal length].
constexpr double kMatrixTolerance = 1e-3;
/// Rows of a rectified pair are the same to less than a matcher can tell [px].
constexpr double kRowTolerance_px = 0.1;
/// No lens shows anything so many times as large as beside its axis.
constexpr double kLargestStretch = 3.0;
/// Rays are followed in such steps and so far off the axis [tangent; 87 degrees].
constexpr double kTangentStep = 0.005, kLargestTangent = 20.0;
/// T and P2 tell the same baseline but for rounding; more are two units or two calibrations.
constexpr double kBaselineTolerance = 0.05;
/// cv::stereoRectify may move the principal point out of the image, but not by more than so many
/// image sizes where the cameras look the same way.
constexpr double kRectifiedSlack = 1.0;

bool differs(double a, double b, double largest_ratio) {
  return std::max(a / b, b / a) > largest_ratio;
}

void check_square(const YamlReader& yaml, const std::string& key, double fx, double fy) {
  if (!differs(fx, fy, kLargestFocalRatio)) return;
  yaml.fail(key, "has focal lengths " + text_of(fx) + " and " + text_of(fy) + " px",
            "a camera has about the same for both; calibrate again");
}

/// A number that nobody wrote is 0; no lens' axis meets the image's border to the last digit.
void check_written(const YamlReader& yaml, const std::string& key, double cx, double cy) {
  if (cx != 0.0 && cy != 0.0) return;
  yaml.fail(key, "has its principal point at (" + text_of(cx) + ", " + text_of(cy) + ")",
            "neither may be exactly 0, which is written where it is not known; calibrate again");
}

/// Where a ray comes out by the radial part of OpenCV's models, that leaves at this tangent to the
/// axis [focal lengths].
double distorted(const LensCalibration& lens, double tangent) {
  const std::vector<double>& D = lens.distortion;
  const auto k = [&D](std::size_t index) { return index < D.size() ? D[index] : 0.0; };
  if (lens.model == LensModel::kFisheye) {
    const double angle = std::atan(tangent);
    const double a2 = angle * angle;
    return angle * (1.0 + a2 * (k(0) + a2 * (k(1) + a2 * (k(2) + a2 * k(3)))));
  }
  const double r2 = tangent * tangent;
  return tangent * (1.0 + r2 * (k(0) + r2 * (k(1) + r2 * k(4)))) /
         (1.0 + r2 * (k(5) + r2 * (k(6) + r2 * k(7))));
}

/// How far the image reaches from the principal point along its longer axis [focal lengths].
double reach(const PinholeCamera& camera) {
  return std::max(std::max(camera.cx, camera.width - camera.cx) / camera.fx,
                  std::max(camera.cy, camera.height - camera.cy) / camera.fy);
}

}  // namespace

std::string text_of(double value) { return formatted("%g", value); }

PinholeCamera checked_pinhole(const YamlReader& yaml, const std::string& key, int width, int height,
                              const Eigen::Matrix3d& K) {
  if (K(0, 0) <= 0.0 || K(1, 1) <= 0.0) {
    yaml.fail(key, "has focal lengths " + text_of(K(0, 0)) + " and " + text_of(K(1, 1)) + " px",
              "both must be > 0");
  }
  const double tolerance = kMatrixTolerance * K(0, 0);
  if (std::abs(K(0, 1)) > tolerance || std::abs(K(1, 0)) > tolerance || K(2, 0) != 0.0 ||
      K(2, 1) != 0.0 || std::abs(K(2, 2) - 1.0) > kMatrixTolerance) {
    yaml.fail(key, "is no camera matrix", "must be fx 0 cx, 0 fy cy, 0 0 1");
  }
  check_square(yaml, key, K(0, 0), K(1, 1));
  check_written(yaml, key, K(0, 2), K(1, 2));
  if (K(0, 2) < 0.0 || K(0, 2) >= width || K(1, 2) < 0.0 || K(1, 2) >= height) {
    yaml.fail(key,
              "has its principal point (" + text_of(K(0, 2)) + ", " + text_of(K(1, 2)) +
                  ") outside the image of " + size_text(width, height),
              "give the calibration of this image size");
  }
  return {width, height, K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
}

std::optional<DistortionFault> distortion_fault(const LensCalibration& lens) {
  const auto is_zero = [](double coefficient) { return coefficient == 0.0; };
  if (std::all_of(lens.distortion.begin(), lens.distortion.end(), is_zero)) return std::nullopt;
  const double end = reach(lens.camera);
  double last = 0.0;
  for (double tangent = kTangentStep; last < end; tangent += kTangentStep) {
    const bool leaves_pinholes = tangent > kLargestTangent;
    // A fisheye's image may well reach farther; no rectified image shows it.
    if (leaves_pinholes && lens.model == LensModel::kFisheye) return std::nullopt;
    const double place = distorted(lens, tangent);
    if (place > kLargestStretch * tangent)
      return DistortionFault{"stretches the image more than " + text_of(kLargestStretch) + " times",
                             "calibrate again"};
    if (!(place > last) || leaves_pinholes)
      return DistortionFault{
          "folds the image: " + text_of(std::round(last * lens.camera.fx)) +
              " px from its middle it ends, and rays farther off the axis come back",
          "calibrate again, with the board also at the image's borders"};
    last = place;
  }
  return std::nullopt;
}

void check_distortion(const YamlReader& yaml, const std::string& key, const LensCalibration& lens) {
  if (const auto fault = distortion_fault(lens)) yaml.fail(key, fault->found, fault->remedy);
}

void check_baseline(const YamlReader& yaml, const std::string& key, const Eigen::Vector3d& T) {
  const double baseline = -T.x();
  if (std::abs(T.y()) > std::abs(T.x())) {
    yaml.fail(key, "puts one camera above the other", "mount them side by side");
  }
  if (std::abs(T.z()) > std::abs(T.x())) {
    yaml.fail(key, "puts one camera in front of the other", "mount them side by side");
  }
  if (baseline <= 0.0) {
    yaml.fail(key, "gives a baseline of " + text_of(baseline) + " m, must be > 0",
              "swap the left and right cameras");
  }
  if (T.norm() < kSmallestBaseline_m) {
    yaml.fail(key, "gives a baseline of " + text_of(T.norm()) + " m", "write it in metres");
  }
  check_near(yaml, key, T);
}

void check_near(const YamlReader& yaml, const std::string& key, const Eigen::Vector3d& T) {
  if (T.norm() <= kLargestBaseline_m) return;
  yaml.fail(key, "gives a baseline of " + text_of(T.norm()) + " m, must be < 5",
            "write it in metres, not millimetres or board squares");
}

void check_alike(const YamlReader& yaml, const std::string& matrix_key,
                 const std::string& rotation_key, const StereoCalibration& calibration) {
  if (differs(calibration.right.camera.fx, calibration.left.camera.fx, kLargestFocalRatio)) {
    yaml.fail(matrix_key,
              "has a focal length of " + text_of(calibration.right.camera.fx) +
                  " px, the left camera " + text_of(calibration.left.camera.fx),
              "give both cameras like lenses, or calibrate again");
  }
  const double turn_deg = kDegreesPerRadian<double> * Eigen::AngleAxisd(calibration.R).angle();
  if (turn_deg > kLargestTurn_deg) {
    yaml.fail(rotation_key, "turns the cameras by " + text_of(turn_deg) + " degrees",
              "must be at most " + text_of(kLargestTurn_deg) +
                  "; mount them to look the same way, and calibrate again");
  }
}

void check_rectified(const YamlReader& yaml, const std::string& key,
                     const Eigen::Matrix<double, 3, 4>& P, const PinholeCamera& camera) {
  if (P(0, 0) <= 0.0 || P(1, 1) <= 0.0)
    yaml.fail(key, "has no focal length > 0", "calibrate again");
  check_square(yaml, key, P(0, 0), P(1, 1));
  check_written(yaml, key, P(0, 2), P(1, 2));
  if (differs(P(0, 0), camera.fx, kLargestRectifiedZoom)) {
    yaml.fail(key,
              "has a focal length of " + text_of(P(0, 0)) + " px, the lens " + text_of(camera.fx),
              "calibrate again, or leave R1 R2 P1 P2 out");
  }
  const auto is_near = [](double place, int size) {
    return place >= -kRectifiedSlack * size && place < (1.0 + kRectifiedSlack) * size;
  };
  if (is_near(P(0, 2), camera.width) && is_near(P(1, 2), camera.height)) return;
  yaml.fail(key,
            "has its principal point (" + text_of(P(0, 2)) + ", " + text_of(P(1, 2)) +
                ") far outside the image of " + size_text(camera.width, camera.height),
            "calibrate again, or give the calibration of this image size");
}

void check_rows_match(const YamlReader& yaml, const std::string& key,
                      const Rectification& rectification) {
  const auto& P1 = rectification.P1;
  const auto& P2 = rectification.P2;
  const double tolerance = kMatrixTolerance * P1(0, 0);
  if (std::abs(P1(0, 0) - P2(0, 0)) <= tolerance && std::abs(P1(1, 1) - P2(1, 1)) <= tolerance &&
      std::abs(P1(1, 2) - P2(1, 2)) <= kRowTolerance_px)
    return;
  yaml.fail(key, "has another focal length or other rows than the left camera's",
            "rectify both to the same rows, or leave R1 R2 P1 P2 out");
}

void check_same_baseline(const YamlReader& yaml, const Eigen::Vector3d& T,
                         const Eigen::Matrix<double, 3, 4>& P2) {
  const double rectified_m = -P2(0, 3) / P2(0, 0);
  if (std::abs(T.norm() - rectified_m) <= kBaselineTolerance * T.norm()) return;
  yaml.fail("P2",
            "has a baseline of " + text_of(rectified_m) + " m, 'T' of " + text_of(T.norm()) + " m",
            "give both of one calibration, in metres, or leave R1 R2 P1 P2 out");
}

}  // namespace limbcast
