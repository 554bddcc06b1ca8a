#pragma once

#include <string>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/calibrate/fit_params.hpp"
#include "modules/calibrate/lens_fit.hpp"
#include "modules/calibrate/outlying_points.hpp"
#include "modules/calibrate/views.hpp"

namespace limbcast::calibrate {

/// How well one view fits.
struct ViewFit {
  std::string name;
  int num_points = 0;                                              ///< that both images show
  double reprojection_left_px = 0.0, reprojection_right_px = 0.0;  ///< RMS
  /// Of them, those that both rectified images show: less of a fisheye's.
  int num_rectified = 0;
  double epipolar_px = 0.0;  ///< RMS difference of their rows
  double distance_m = 0.0;   ///< of the board's middle from the left camera
  /// Angle between the board and the image, about the image's y axis (to the left or right) and x
  /// axis (up or down).
  double tilt_sideways_deg = 0.0, tilt_updown_deg = 0.0;
};

struct StereoFit {
  StereoCalibration calibration;  ///< with rectification
  std::vector<View> views;        ///< that it rests on, without outlying points
  std::vector<ViewFit> figures;   ///< one for each of them
  std::vector<RejectedView> outliers;
  std::vector<OutlyingPoint> outlying_points;
  double reprojection_px = 0.0, epipolar_px = 0.0;  ///< RMS of all points
  LensUncertainty left, right;
  Distortion distortion = Distortion::kWithK3;  ///< that was sought
};

/// Throws std::runtime_error, with the reasons why others were rejected, where there are too few
/// views.
void check_enough(const std::vector<View>& views, const std::vector<RejectedView>& rejected,
                  const FitParams& params = {});

/// Lenses and pose of a stereo pair from views of a board (Zhang 2000; cv::calibrateCamera for each
/// camera, then cv::stereoCalibrate for all at once), again without the worst view as long as that
/// one is an outlier, by the lenses of each camera alone or of all at once. Single points that
/// their board's others put elsewhere are left out first (fit_good_points). Where a lens folds the
/// image, as k3 may do beyond the boards, these views and points again without k3. Lenses of
/// `model`; fisheyes by least squares in place of OpenCV's functions. Throws std::runtime_error
/// where there are too few views.
StereoFit fit_stereo(const std::vector<View>& views, const Board& board, const cv::Size& image_size,
                     LensModel model = LensModel::kPinhole, const FitParams& params = {});

/// Points of the board in both rectified images [px].
struct RectifiedPoints {
  std::vector<int> ids;
  std::vector<cv::Point2d> left, right;
};
/// Those of `calibration`'s rectification; of fisheye lenses only the points that its images show,
/// since far off the axis, where those end, all errors grow without limit.
RectifiedPoints rectified_points(const CommonPoints& common, const StereoCalibration& calibration);

}  // namespace limbcast::calibrate
