#pragma once

#include <opencv2/core/mat.hpp>

#include "common/camera/calibration.hpp"

/// Where lenses put points, by OpenCV's functions for the lens' model: arguments are theirs.
namespace limbcast {

/// Whether the lens shows anything elsewhere than its ideal camera does.
bool has_distortion(const LensCalibration& lens);

/// cv::projectPoints: the pixels of `points`, turned by `rotation` and moved by `translation`.
void project_points(cv::InputArray points, cv::InputArray rotation, cv::InputArray translation,
                    const LensCalibration& lens, cv::OutputArray pixels);

/// cv::undistortPoints: where `pixels` stand in the image of the ideal camera `P` that is turned by
/// `R`; without them, the tangents of their rays. Pixels that a fisheye sees 90 degrees off its
/// axis or farther have no place there; what comes out for them is any.
void undistort_points(cv::InputArray pixels, cv::OutputArray points, const LensCalibration& lens,
                      cv::InputArray R = cv::noArray(), cv::InputArray P = cv::noArray());

/// Maps for cv::remap.
struct LensMaps {
  cv::Mat xy, fraction;
};
/// cv::initUndistortRectifyMap: from the image of the ideal camera `K`, which is turned by `R`, to
/// the lens'.
LensMaps undistorting_maps(const LensCalibration& lens, cv::InputArray R, cv::InputArray K,
                           const cv::Size& size);

}  // namespace limbcast
