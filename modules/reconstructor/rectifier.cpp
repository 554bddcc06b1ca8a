#include "modules/reconstructor/rectifier.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "common/camera/opencv_conversion.hpp"
#include "common/formatted.hpp"
#include "modules/reconstructor/rectification.hpp"

namespace limbcast::reconstructor {
namespace {

/// Throws where hardly anything of the images would be left, or nothing: what cv::stereoRectify and
/// compute_rectification find for cameras that do not see the same has no meaning.
void check_shows_something(const Rectification& rectification, const PinholeCamera& lens) {
  const double focal_px = rectification.P1(0, 0);
  if (rectification.P1.allFinite() && focal_px > 0.0 && focal_px <= kLargestRectifiedZoom * lens.fx)
    return;
  throw std::invalid_argument(
      formatted("calibration: rectified images would show nothing that both cameras see (focal "
                "length %.4g px, of the lens %.4g px); calibrate again",
                focal_px, lens.fx));
}

/// Of P2 = [f 0 cx -f*B; ...].
double baseline_of(const Rectification& rectification) {
  return -rectification.P2(0, 3) / rectification.P2(0, 0);
}

/// Throws where the pair is no left and right one.
void check_baseline(const Rectification& rectification) {
  const double focal_px = rectification.P2(0, 0);
  if (!(focal_px > 0.0)) throw std::invalid_argument("calibration: focal length in P2 must be > 0");
  std::ostringstream text;
  if (std::abs(rectification.P2(1, 3)) > std::abs(rectification.P2(0, 3))) {
    text << "calibration: the cameras stand above one another (P2 says "
         << -rectification.P2(1, 3) / focal_px << " m); only side by side is supported";
    throw std::invalid_argument(text.str());
  }
  if (!(baseline_of(rectification) > 0.0)) {
    text << "calibration: the baseline is " << baseline_of(rectification)
         << " m, must be > 0: left and right are swapped";
    throw std::invalid_argument(text.str());
  }
}

bool is_identity(const LensCalibration& lens, const Eigen::Matrix3d& rotation,
                 const PinholeCamera& rectified) {
  constexpr double kSamePx = 1e-3;  // far below what a match can tell
  if (has_distortion(lens)) return false;
  const PinholeCamera& camera = lens.camera;
  return rotation.isApprox(Eigen::Matrix3d::Identity(), 1e-9) && camera.width == rectified.width &&
         camera.height == rectified.height && std::abs(camera.fx - rectified.fx) < kSamePx &&
         std::abs(camera.fy - rectified.fy) < kSamePx &&
         std::abs(camera.cx - rectified.cx) < kSamePx &&
         std::abs(camera.cy - rectified.cy) < kSamePx;
}

PinholeCamera scaled(const PinholeCamera& camera, double scale) {
  PinholeCamera result = camera;
  result.width = static_cast<int>(std::lround(camera.width * scale));
  result.height = static_cast<int>(std::lround(camera.height * scale));
  const double scale_x = static_cast<double>(result.width) / camera.width;
  const double scale_y = static_cast<double>(result.height) / camera.height;
  result.fx *= scale_x;
  result.fy *= scale_y;
  // Pixel centres are whole numbers, so the image begins at -0.5.
  result.cx = (camera.cx + 0.5) * scale_x - 0.5;
  result.cy = (camera.cy + 0.5) * scale_y - 0.5;
  return result;
}

void check_size(const cv::Mat& image, const PinholeCamera& lens, const char* side) {
  if (image.cols == lens.width && image.rows == lens.height) return;
  std::ostringstream text;
  text << side << " image is " << image.cols << "x" << image.rows << ", the calibration says "
       << lens.width << "x" << lens.height;
  throw std::invalid_argument(text.str());
}

}  // namespace

Rectification usable_rectification(const StereoCalibration& calibration) {
  const PinholeCamera& lens = calibration.left.camera;
  if (lens.width <= 0 || lens.height <= 0)
    throw std::invalid_argument("calibration: image size must be > 0");
  Rectification rectification =
      calibration.rectification ? *calibration.rectification : compute_rectification(calibration);
  check_shows_something(rectification, lens);
  check_baseline(rectification);
  return rectification;
}

Rectifier::Rectifier(const StereoCalibration& calibration, double image_scale)
    : lens_left_(calibration.left.camera), lens_right_(calibration.right.camera) {
  const Rectification rectification = usable_rectification(calibration);
  baseline_m_ = baseline_of(rectification);
  const PinholeCamera full{lens_left_.width,       lens_left_.height,      rectification.P1(0, 0),
                           rectification.P1(1, 1), rectification.P1(0, 2), rectification.P1(1, 2)};
  camera_ = scaled(full, image_scale);

  // Both images are resampled with the left camera's matrix, so that a point at infinity has
  // disparity 0 even where the calibration gives the two different principal points.
  const auto make_maps = [&](const LensCalibration& lens, const Eigen::Matrix3d& rotation) {
    if (is_identity(lens, rotation, full)) return LensMaps{};
    return undistorting_maps(lens, to_cv(rotation), camera_matrix(full),
                             cv::Size(full.width, full.height));
  };
  left_maps_ = make_maps(calibration.left, rectification.R1);
  right_maps_ = make_maps(calibration.right, rectification.R2);
}

cv::Mat Rectifier::resample(const cv::Mat& image, const LensMaps& maps) const {
  cv::Mat result;
  if (maps.xy.empty())
    result = image;
  else  // into memory of its own: a copy of `image` shares the caller's pixels
    cv::remap(image, result, maps.xy, maps.fraction, cv::INTER_LINEAR);
  const cv::Size size(camera_.width, camera_.height);
  if (result.size() == size) return result;
  cv::Mat smaller;
  cv::resize(result, smaller, size, 0.0, 0.0, cv::INTER_AREA);
  return smaller;
}

RectifiedPair Rectifier::rectify(const cv::Mat& left, const cv::Mat& right) const {
  check_size(left, lens_left_, "left");
  check_size(right, lens_right_, "right");
  return {resample(left, left_maps_), resample(right, right_maps_)};
}

}  // namespace limbcast::reconstructor
