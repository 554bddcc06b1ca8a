#pragma once

#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::reconstructor {

struct NearLookParams {
  /// Width of the images that are looked at [px]: a quarter of VGA, a sixteenth of the pixels.
  int width_px = 160;
  /// Smaller groups of their pixels are mistakes of the matcher: a fist at 0.8 m has 130.
  int min_pixels = 40;
  /// Differences of brightness that a near surface leaves, against those of the best that is not
  /// near. Of people at 0.6 to 1.3 m 0.2 to 0.4; of wallpaper that repeats itself 0.36 to 2.3, with
  /// one in fourteen below 0.5.
  double max_misfit = 0.5;
};

/// Disparities to search a rectified pair over: `usual` where nothing is nearer, else as many as
/// its nearest surface needs, `most` at most. Searching all of them in every pair would take twice
/// the time, for what is rarely there; searching too few takes what is near for something far.
int find_num_disparities(const RectifiedPair& pair, int usual, int most,
                         const NearLookParams& params = {});

}  // namespace limbcast::reconstructor
