#include "modules/reconstructor/rectification.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <vector>

#include "common/camera/lens_projection.hpp"
#include "common/camera/opencv_conversion.hpp"
#include "common/units.hpp"

namespace limbcast::reconstructor {
namespace {

/// So far off the axis a rectified camera sees what a fisheye lens does [degrees]. A flat image of
/// 180 degrees has no end, and stretches what stands at an angle a to the axis by 1 / cos^2 a:
/// three times here, so that borders would grow at the cost of the middle. With this, in the middle
/// a lens of 180 degrees across its image keeps about its own pixels a degree (w / 2 / tan 55
/// degrees = 0.35 w; w / pi = 0.32 w).
constexpr double kFisheyeReach_deg = 55.0;

/// What a camera sees without a black border: tangents of the angles to its axis.
struct Field {
  double left, right, top, bottom;
};

/// Unit vectors to where the lens sees these pixels, turned by `R`.
std::vector<Eigen::Vector3d> rays_of(const std::vector<cv::Point2d>& pixels,
                                     const LensCalibration& lens, const Eigen::Matrix3d& R) {
  std::vector<cv::Point2d> tangents;
  undistort_points(pixels, tangents, lens);
  std::vector<Eigen::Vector3d> rays;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Eigen::Vector2d side((pixels[i].x - lens.camera.cx) / lens.camera.fx,
                               (pixels[i].y - lens.camera.cy) / lens.camera.fy);
    const Eigen::Vector2d tangent(tangents[i].x, tangents[i].y);
    // What OpenCV finds for a pixel 90 degrees off the axis or farther is not on its side.
    const double angle = tangent.dot(side) > 0.0 ? std::atan(tangent.norm()) : 0.5 * kPi<double>;
    const Eigen::Vector2d across = std::sin(angle) * side.normalized();
    rays.emplace_back(R * Eigen::Vector3d(across.x(), across.y(), std::cos(angle)));
  }
  return rays;
}

/// Tangent, along an axis of the image, of that of these pixels which is farthest inwards.
/// `outwards`: 1 where the border is to the right or below, -1 where it is to the left or above.
double innermost_tangent(const std::vector<cv::Point2d>& border, int axis, double outwards,
                         const LensCalibration& lens, const Eigen::Matrix3d& R) {
  double reach = std::tan(radians(kFisheyeReach_deg));
  for (const Eigen::Vector3d& ray : rays_of(border, lens, R)) {
    if (ray.z() > 0.0) reach = std::min(reach, outwards * ray[axis] / ray.z());
  }
  return outwards * reach;
}

/// That of a camera which is turned by `R` from the lens, as far as a rectified one reaches.
Field field_of(const LensCalibration& lens, const Eigen::Matrix3d& R) {
  const double last_u = lens.camera.width - 1.0;
  const double last_v = lens.camera.height - 1.0;
  std::vector<cv::Point2d> left, right, top, bottom;
  for (double v = 0.0; v <= last_v; ++v) {
    left.emplace_back(0.0, v);
    right.emplace_back(last_u, v);
  }
  for (double u = 0.0; u <= last_u; ++u) {
    top.emplace_back(u, 0.0);
    bottom.emplace_back(u, last_v);
  }
  return {innermost_tangent(left, 0, -1.0, lens, R), innermost_tangent(right, 0, 1.0, lens, R),
          innermost_tangent(top, 1, -1.0, lens, R), innermost_tangent(bottom, 1, 1.0, lens, R)};
}

/// What both see.
Field common(const Field& a, const Field& b) {
  return {std::max(a.left, b.left), std::min(a.right, b.right), std::max(a.top, b.top),
          std::min(a.bottom, b.bottom)};
}

/// The camera in whose image of this size that fits, and nothing else is seen along one axis. Its
/// focal length is infinite where the field holds nothing.
Eigen::Matrix3d camera_of(const Field& field, const cv::Size& size) {
  const double last_u = size.width - 1.0;
  const double last_v = size.height - 1.0;
  const double focal_px = std::max(last_u / std::max(0.0, field.right - field.left),
                                   last_v / std::max(0.0, field.bottom - field.top));
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = K(1, 1) = focal_px;
  K(0, 2) = 0.5 * (last_u - focal_px * (field.left + field.right));
  K(1, 2) = 0.5 * (last_v - focal_px * (field.top + field.bottom));
  return K;
}

/// cv::stereoRectify for pinholes of this distortion.
Rectification by_opencv(const StereoCalibration& calibration, const std::vector<double>& left,
                        const std::vector<double>& right) {
  const cv::Size size(calibration.left.camera.width, calibration.left.camera.height);
  cv::Mat R1, R2, P1, P2, Q;
  cv::stereoRectify(camera_matrix(calibration.left.camera), left,
                    camera_matrix(calibration.right.camera), right, size, to_cv(calibration.R),
                    to_cv(calibration.T), R1, R2, P1, P2, Q, cv::CALIB_ZERO_DISPARITY, 0.0, size);
  Rectification result;
  cv::cv2eigen(R1, result.R1);
  cv::cv2eigen(R2, result.R2);
  cv::cv2eigen(P1, result.P1);
  cv::cv2eigen(P2, result.P2);
  return result;
}

/// Turned as ordinary cameras are; what they see is chosen here, as cv::fisheye::stereoRectify
/// looks at four pixels of the border only and finds nothing where one is 90 degrees off the axis.
Rectification of_fisheyes(const StereoCalibration& calibration) {
  const LensCalibration& left = calibration.left;
  const LensCalibration& right = calibration.right;
  Rectification result = by_opencv(calibration, {}, {});
  const Field seen = common(field_of(left, result.R1), field_of(right, result.R2));
  const Eigen::Matrix3d K = camera_of(seen, {left.camera.width, left.camera.height});
  result.P1.leftCols<3>() = result.P2.leftCols<3>() = K;
  result.P2.col(3) = K(0, 0) * (result.R2 * calibration.T);
  return result;
}

}  // namespace

Rectification compute_rectification(const StereoCalibration& calibration) {
  if (calibration.left.model == LensModel::kFisheye) return of_fisheyes(calibration);
  return by_opencv(calibration, calibration.left.distortion, calibration.right.distortion);
}

}  // namespace limbcast::reconstructor
