#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/calibrate/fit_params.hpp"
#include "modules/calibrate/views.hpp"

namespace limbcast::calibrate {

/// Standard deviations as cv::calibrateCamera estimates them from the residuals.
struct LensUncertainty {
  double focal_px = 0.0, principal_point_px = 0.0;
};

/// From one frame to another: Rodrigues vector, then shift [sides of a square].
struct Pose {
  cv::Mat rotation = cv::Mat::zeros(3, 1, CV_64F), translation = cv::Mat::zeros(3, 1, CV_64F);
};

/// A lens and the board before it, by what one camera alone has seen.
struct Lens {
  LensCalibration calibration;
  LensUncertainty uncertainty;
  std::vector<Pose> boards;  ///< from the board's frame to the camera's, for each view
};

struct Lenses {
  Lens left, right;
};

/// Points of the board [sides of a square] that one camera sees, and their pixels; for each view.
struct SeenPoints {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
};

/// In sides of a square: OpenCV's solvers miss the lens where a board's points lie closer than some
/// tenths of a unit.
cv::Point3f point_in_squares(const Board& board, int id);
std::vector<cv::Point3f> points_of(const Board& board, const std::vector<int>& ids);

/// Terms of distortion that are sought; others stay 0. Of a fisheye k1 and k2, or all four.
enum class Distortion { kWithoutK3, kWithK3, kFisheyeWithoutK3, kFisheye };
bool is_fisheye(Distortion distortion);

/// Of a pinhole, as cv::calibrateCamera and cv::stereoCalibrate take them.
int flags_of(Distortion distortion);
/// A pinhole as they give it.
LensCalibration pinhole_of(const cv::Matx33d& K, const cv::Mat& D, const cv::Size& size);

/// Each camera alone, from all points that it sees (Zhang 2000; cv::calibrateCamera). `size` of an
/// image [px].
Lenses fit_lenses(const std::vector<View>& views, const Board& board, const cv::Size& size,
                  Distortion distortion, const FitParams& params);

/// Where points are that the lens sees at these pixels (cv::solvePnP); from `guess` where there is
/// one.
Pose find_pose(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& pixels,
               const LensCalibration& lens, const std::optional<Pose>& guess,
               const FitParams& params);

/// Lenses and pose of a pair: p_right = R * p_left + T [sides of a square].
struct PairFit {
  LensCalibration left, right;
  Eigen::Matrix3d R;
  Eigen::Vector3d T;
  std::vector<cv::Vec2d> errors_px;  ///< RMS in the left and right image of each view
};

/// Standard deviation of the focal length of the lens that is known less well, as a share of it.
double focal_sigma(const Lenses& lenses);

}  // namespace limbcast::calibrate
