#pragma once

#include <string>
#include <vector>

#include "modules/calibrate/stereo_fit.hpp"

/// Whether a calibration may be used.
namespace limbcast::calibrate {

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
