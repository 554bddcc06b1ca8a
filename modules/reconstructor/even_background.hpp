#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/reconstructor/census.hpp"

namespace limbcast::reconstructor {

/// Where the image is even (no census bit) every disparity fits alike, and a wall beside a person
/// would get the person's. A surface that hides none is behind, so a near disparity costs more
/// there. But even clothes and skin would get the wall's: what is even counts as background only
/// where it can hardly be a person's.
struct EvenBackgroundParams {
  /// There a disparity costs at least one census bit for every so many [px]. Fewer: silhouettes
  /// shrink (precision 0.87 without it, 0.89 with 8, 0.90 with 4).
  int px_per_bit = 8;
  /// An even region that takes up this share of the image is background, wherever it lies: as much
  /// as a coat of one colour 2 m away.
  double min_share = 1.0 / 12.0;
  /// So is one as bright as the background that lies beside it, as what shows between an arm and
  /// the trunk: up to this difference [grey levels],
  double max_difference = 5.0;
  /// this far from its bounding box [px], about as wide as an arm 2 m away,
  int beside_px = 40;
  /// if so much of it [px] tells how bright it is,
  int min_beside_px = 100;
  /// and the region is no smaller than this [px]: texture has such spots.
  int min_alike_px = 35;
};

/// 255 where the image is even and what is there must be a wall, a ceiling or the sky: in regions
/// that reach its left, right or upper border or are large, and in what is alike beside them. The
/// lower border tells nothing: people are cut by it, too.
cv::Mat1b even_background(const cv::Mat1b& grey, const Census& census,
                          const EvenBackgroundParams& params);

}  // namespace limbcast::reconstructor
