#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limbcast {

/// The middle one of these values, which must not be empty; of an even number the upper of the two
/// in the middle.
template <class Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace limbcast
