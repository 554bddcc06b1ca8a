#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/calibrate/stereo_fit.hpp"

namespace limbcast::calibrate {

enum class Side { kLeft, kRight };

/// Where in the image the boards stood: 8 bit, 255 = inside of one; of the image's size.
cv::Mat covered_area(const std::vector<View>& views, Side side, const cv::Size& image_size);
/// Share of the image [0, 1].
double share_of(const cv::Mat& covered);

struct AdviceParams {
  /// A ninth of the image counts as covered from this share of its area.
  double min_region_share = 0.5;
  /// A board that is tilted by this much shows the perspective from which the focal length
  /// follows; near 45 degrees it is known best (Zhang 2000, fig. 3).
  double tilt_deg = 15.0;
  /// So many views each should be tilted sideways and up or down.
  int tilted_views = 3;
  /// Farthest and nearest board should differ by this factor.
  double distance_ratio = 1.4;
};

/// Which shots to add, a sentence each; empty where nothing is missing.
std::vector<std::string> advise(const StereoFit& fit, const cv::Size& image_size,
                                const AdviceParams& params = {});

}  // namespace limbcast::calibrate
