#include "common/camera/lens_projection.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "common/camera/opencv_conversion.hpp"

namespace limbcast {
namespace {

bool is_fisheye(const LensCalibration& lens) { return lens.model == LensModel::kFisheye; }

}  // namespace

bool has_distortion(const LensCalibration& lens) {
  return is_fisheye(lens) || std::any_of(lens.distortion.begin(), lens.distortion.end(),
                                         [](double coefficient) { return coefficient != 0.0; });
}

void project_points(cv::InputArray points, cv::InputArray rotation, cv::InputArray translation,
                    const LensCalibration& lens, cv::OutputArray pixels) {
  const cv::Matx33d K = camera_matrix(lens.camera);
  if (is_fisheye(lens))
    cv::fisheye::projectPoints(points, pixels, rotation, translation, K, lens.distortion);
  else
    cv::projectPoints(points, rotation, translation, K, lens.distortion, pixels);
}

void undistort_points(cv::InputArray pixels, cv::OutputArray points, const LensCalibration& lens,
                      cv::InputArray R, cv::InputArray P) {
  const cv::Matx33d K = camera_matrix(lens.camera);
  if (is_fisheye(lens))
    cv::fisheye::undistortPoints(pixels, points, K, lens.distortion, R, P);
  else
    cv::undistortPoints(pixels, points, K, lens.distortion, R, P);
}

LensMaps undistorting_maps(const LensCalibration& lens, cv::InputArray R, cv::InputArray K,
                           const cv::Size& size) {
  const cv::Matx33d lens_K = camera_matrix(lens.camera);
  LensMaps maps;
  if (is_fisheye(lens))
    cv::fisheye::initUndistortRectifyMap(lens_K, lens.distortion, R, K, size, CV_16SC2, maps.xy,
                                         maps.fraction);
  else
    cv::initUndistortRectifyMap(lens_K, lens.distortion, R, K, size, CV_16SC2, maps.xy,
                                maps.fraction);
  return maps;
}

}  // namespace limbcast
