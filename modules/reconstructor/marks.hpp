#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

namespace limbcast::reconstructor {

// Rows of bytes that vectors set to 0 or 1, pixel for pixel, and that are then searched by the C
// library, which looks at many at a time.

/// The first pixel from `from` on whose byte is `mark`, else the row's width.
inline int find_mark(const std::vector<std::uint8_t>& row, int from, std::uint8_t mark = 1) {
  const auto width = static_cast<int>(row.size());
  if (from >= width) return width;
  const void* found = std::memchr(row.data() + from, mark, static_cast<std::size_t>(width - from));
  if (found == nullptr) return width;
  return static_cast<int>(static_cast<const std::uint8_t*>(found) - row.data());
}

}  // namespace limbcast::reconstructor
