#pragma once

#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/skin_color.hpp"

namespace limbcast::segmenter {

/// Fills points_m, is_skin and range_image of `segment` with the pixels of `cloud` whose `labels`
/// equal `label`, and what the sensor saw up to `margin_m` beside them. `skin` is only asked where
/// there is colour.
void fill_from_camera(const Cloud& cloud, const std::vector<std::int16_t>& labels,
                      std::int16_t label, float margin_m, const SkinColor& skin,
                      float min_log_ratio, Segment& segment);

}  // namespace limbcast::segmenter
