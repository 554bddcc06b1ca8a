#pragma once

#include <limbcast/point_cloud_t.hpp>

#include "common/cloud/cloud.hpp"

namespace limbcast::lcm_io {

/// Colours of an organised cloud are coded as JPEG of that quality; those of a list stay as they
/// are.
point_cloud_t to_message(const Cloud& cloud, int jpeg_quality = 85);
/// Throws MessageError where sizes, layout, numbers or compressed data do not fit together.
Cloud from_message(const point_cloud_t& message);

}  // namespace limbcast::lcm_io
