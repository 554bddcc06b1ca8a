#pragma once

#include <cstdint>
#include <vector>

namespace limbcast::reconstructor {

/// Of each pixel of a row the disparity whose cost is lowest; of equal ones the least.
class LowestCosts {
 public:
  /// `size`: bytes of a pixel's costs, see MatchingCosts.
  LowestCosts(int width, int size, int num_disparities);

  /// Of the left image's pixels; `costs` are [pixel][disparity].
  void find_left(const std::uint8_t* costs, std::uint8_t* disparities) const;
  /// Of the right image's pixels x, at [width - 1 - x]: they see at d what the left image's pixels
  /// x + d see. Costs may be read a register beyond both ends, and as many disparities are written
  /// beyond the last.
  void find_right(const std::uint8_t* costs, std::uint8_t* disparities_mirrored) const;

 private:
  int width_, size_, num_disparities_;
  /// Makes costs beyond the disparities searched the highest: 255 there, 0 within; from a
  /// register's bytes before them to as many after them.
  std::vector<std::uint8_t> unsearched_;
};

}  // namespace limbcast::reconstructor
