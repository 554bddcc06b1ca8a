#pragma once

#include "modules/calibrate/fit_params.hpp"
#include "modules/calibrate/lens_fit.hpp"

/// What cv::calibrateCamera, cv::stereoCalibrate and cv::solvePnP do, for fisheye lenses: OpenCV's
/// own fits of those give up where a view is ill-conditioned or the first guess bad.
namespace limbcast::calibrate {

/// A lens and the board before it, by what one camera has seen.
Lens fit_fisheye(const SeenPoints& seen, const cv::Size& size, Distortion distortion,
                 const FitParams& params);

/// Lenses and pose of a pair, all at once, from those that each camera alone has found.
PairFit refine_fisheyes(const Lenses& lenses, const Pose& right_from_left, const SeenPoints& left,
                        const SeenPoints& right, Distortion distortion, const FitParams& params);

/// Where points are that the lens sees at these pixels; from `guess` where there is one.
Pose fisheye_pose(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& pixels,
                  const LensCalibration& lens, const std::optional<Pose>& guess,
                  const FitParams& params);

}  // namespace limbcast::calibrate
