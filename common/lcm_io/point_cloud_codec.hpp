#pragma once

#include <cstdint>
#include <limbcast/point_cloud_t.hpp>

#include "common/cloud/cloud.hpp"

namespace limbcast::lcm_io {

/// Points of a cloud that is taken for sound, so that others are not sent. More than any sensor on
/// a robot gives in one frame; guards against nonsense in a message.
inline constexpr std::int64_t kMaxPoints = 8'000'000;

/// Colours of an organised cloud are coded as JPEG of that quality; those of a list stay as they
/// are.
point_cloud_t to_message(const Cloud& cloud, int jpeg_quality = 85);
/// Throws MessageError where sizes, layout, numbers or compressed data do not fit together.
Cloud from_message(const point_cloud_t& message);

}  // namespace limbcast::lcm_io
