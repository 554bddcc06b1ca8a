#pragma once

#include <vector>

#include "modules/reconstructor/corner_tracks.hpp"

namespace limbcast::reconstructor {

/// Row in the right image minus row in the left one [px] of the corners that both images of a
/// rectified, 8-bit grey pair show. With a calibration that fits they scatter about 0.
std::vector<double> row_differences_px(const RectifiedPair& pair);

/// Median of the sizes of row differences, which must not be empty: the size also shows a camera
/// that rolled, whose differences on the left are the opposite of those on the right.
double median_size_px(std::vector<double> differences_px);

}  // namespace limbcast::reconstructor
