#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/calibrate/seen_area.hpp"
#include "modules/calibrate/stereo_fit.hpp"

namespace limbcast::calibrate {

/// Where in the image the boards stood: 8 bit, 255 = inside of one; of the image's size.
cv::Mat covered_area(const std::vector<View>& views, Side side, const cv::Size& image_size);
/// Share of what the camera sees that the boards covered [0, 1].
double coverage(const std::vector<View>& views, Side side, const SeenAreas& seen);
/// Of the camera of which less is covered.
double least_coverage(const std::vector<View>& views, const SeenAreas& seen);

struct AdviceParams {
  /// A ninth of the image, from border to border of what the lens sees, counts as covered from this
  /// share of it; where the lens sees but a part of it, from this share of that part of the part:
  /// of rendered boards that were held at 26 places all over an image circle the least was 0.69.
  double min_region_share = 0.5;
  /// A board that is tilted by this much shows the perspective from which the focal length
  /// follows; near 45 degrees it is known best (Zhang 2000, fig. 3).
  double tilt_deg = 15.0;
  /// So many views each should be tilted sideways and up or down.
  int tilted_views = 3;
  /// Farthest and nearest board should differ by this factor.
  double distance_ratio = 1.4;
};

/// Which parts of the images no board has covered yet, a sentence for each camera.
std::vector<std::string> advise_places(const std::vector<View>& views, const SeenAreas& seen,
                                       const AdviceParams& params = {});

/// Which shots to add, a sentence each; empty where nothing is missing.
std::vector<std::string> advise(const StereoFit& fit, const SeenAreas& seen,
                                const AdviceParams& params = {});

struct CompletionParams {
  /// So many views are enough where nothing is missing in them; 15 to 30 are the usual advice, and
  /// rendered boards reach focal length and baseline to 0.3 and 0.5 % with 10.
  int enough_views = 15;
  /// So many are enough in any case: errors fall with the root of their number, so more views cost
  /// time and give little.
  int most_views = 30;
};

/// Whether a video or camera has shown enough: a calibration from these views may be used, and no
/// shots are to be added. Lenses of `model`.
bool complete(const std::vector<View>& views, const Board& board, const SeenAreas& seen,
              LensModel model, const CompletionParams& params = {});

}  // namespace limbcast::calibrate
