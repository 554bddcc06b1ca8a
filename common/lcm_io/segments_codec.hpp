#pragma once

#include <limbcast/segments_t.hpp>

#include "common/cloud/segment.hpp"

namespace limbcast::lcm_io {

/// Points of a segment with a window of a camera's lattice are the window's person pixels, row by
/// row, and are not sent twice.
segments_t to_message(const Segments& segments);
/// Throws MessageError where sizes, labels, numbers or compressed data do not fit together.
Segments from_message(const segments_t& message);

}  // namespace limbcast::lcm_io
