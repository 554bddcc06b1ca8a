#pragma once

#include <string>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/calibrate/fit_params.hpp"
#include "modules/calibrate/lens_fit.hpp"
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
  std::vector<View> views;        ///< that it rests on
  std::vector<ViewFit> figures;   ///< one for each of them
  std::vector<RejectedView> outliers;
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
/// one is an outlier, by the lenses of each camera alone or of all at once. Where a lens folds the
/// image, as k3 may do beyond the boards, all of it without k3. Lenses of `model`; fisheyes by
/// least squares in place of OpenCV's functions. Throws std::runtime_error where there are too few
/// views.
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

struct Verdict {
  std::vector<std::string> faults;    ///< why the result must not be used; empty: it may
  std::vector<std::string> warnings;  ///< what makes it worse than it could be
};

struct VerdictParams {
  /// RMS over all points. A fit of sharp pictures of a flat board reaches 0.1 to 0.4 px; printing
  /// on paper that bends, 0.5.
  double max_reprojection_px = 1.0;
  /// Rows must agree to a fraction of a pixel, or the matcher finds nothing in fine texture.
  double max_epipolar_px = 0.8;
  /// Views that did not fit, more than so many and than this share of all: with cameras that are
  /// not triggered together and a board that moves none fits, and what is left agrees by chance. On
  /// such views the focal length came out wrong by up to 3 % and the baseline by 12 %.
  int max_outliers = 2;
  double max_outlier_share = 0.25;
  /// Standard deviation of the focal length as a share of it; depth is wrong by the same share.
  double max_focal_sigma = 0.01;
  /// Boards parallel to the image do not tell the focal length from the distance (Zhang 2000), and
  /// their standard deviation does not show it: so many views must be tilted by so much.
  int min_tilted_views = 3;
  double min_tilt_deg = 8.0;
  /// Difference of the focal lengths fx, fy of one lens as a share: pixels are square.
  double max_aspect_error = 0.05;
  /// Share of the image that the boards must have covered: outside of it distortion is a guess. On
  /// rendered boards, with 25 to 35 % the focal lengths are right within 0.1 %, but in the corners
  /// depth is wrong by 3 to 5 %; with 20 % half the image is.
  double min_coverage = 0.25;
  /// Less coverage and fewer views are warnings.
  double enough_coverage = 0.35;
  int enough_views = 10;
  /// Cameras nearer to one another or farther apart are a warning [m]: a square was rather told in
  /// centimetres or metres.
  double min_usual_baseline_m = 0.015, max_usual_baseline_m = 1.0;
};

Verdict judge(const StereoFit& fit, double coverage, const VerdictParams& params = {});

}  // namespace limbcast::calibrate
