#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "modules/calibrate/views.hpp"

namespace limbcast::calibrate {

/// Standard deviations as cv::calibrateCamera estimates them from the residuals.
struct LensUncertainty {
  double focal_px = 0.0, principal_point_px = 0.0;
};

/// A lens and the board before it, by what one camera alone has seen.
struct Lens {
  cv::Mat K, D;  ///< camera matrix [px]; k1 k2 p1 p2 k3
  LensUncertainty uncertainty;
  /// From the board's frame to the camera's, for each view (Rodrigues vectors; sides of a square).
  std::vector<cv::Mat> rotations, translations;
};

struct Lenses {
  Lens left, right;
};

/// In sides of a square: OpenCV's solvers miss the lens where a board's points lie closer than some
/// tenths of a unit.
cv::Point3f point_in_squares(const Board& board, int id);
std::vector<cv::Point3f> points_of(const Board& board, const std::vector<int>& ids);

/// Terms of distortion that are sought; others stay 0.
enum class Distortion { kWithoutK3, kWithK3 };

/// As cv::calibrateCamera and cv::stereoCalibrate take them.
int flags_of(Distortion distortion);

/// Each camera alone, from all points that it sees (Zhang 2000; cv::calibrateCamera). `size` of an
/// image [px].
Lenses fit_lenses(const std::vector<View>& views, const Board& board, const cv::Size& size,
                  Distortion distortion);

/// Standard deviation of the focal length of the lens that is known less well, as a share of it.
double focal_sigma(const Lenses& lenses);

}  // namespace limbcast::calibrate
