#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::reconstructor {

struct CornerParams {
  /// Corners (Shi and Tomasi 1994) looked for in the left image; a VGA room shows some 250.
  int max_corners = 300;
  /// Weakest corner as a share of the strongest one's least eigenvalue, and the distance between
  /// two [px]; by eye on stereo_dev: corners all over the image, few of them noise.
  double min_quality = 0.02, min_spacing_px = 10.0;
  /// Side of the window that is tracked [px], and how often the images are halved for it.
  int window_px = 21, pyramid_levels = 5;
  /// A corner that is tracked into the right image and back must come to where it was [px]; none:
  /// corners are not tracked back.
  std::optional<double> max_return_px = 0.3;
  /// Larger row differences are wrong matches [px]: a drift of 2 degrees gives 18 px at 520 px of
  /// focal length.
  double max_difference_px = 24.0;
};

/// Where both images show the same corner [px].
struct CornerTrack {
  cv::Point2f left, right;
};

/// Corners of a nearly rectified, 8-bit grey pair, tracked from the left into the right image
/// (Lucas and Kanade 1981).
std::vector<CornerTrack> track_corners(const RectifiedPair& pair, const CornerParams& params = {});

/// The same corners tracked once more, in a larger pair that is `scale` times as wide: those whose
/// place in the right image moves by less than `max_move_px` of the larger pair's pixels.
std::vector<CornerTrack> track_again(const std::vector<CornerTrack>& corners,
                                     const RectifiedPair& larger, float scale, int window_px,
                                     double max_move_px);

}  // namespace limbcast::reconstructor
