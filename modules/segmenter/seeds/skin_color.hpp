#pragma once

#include <array>
#include <cstdint>

#include "common/cloud/cloud.hpp"

namespace limbcast::segmenter {

/// Skin from colour: the likelihood ratio of two mixtures of 16 Gaussians, fitted to a billion
/// pixels of web images (Jones and Rehg, "Statistical color models with application to skin
/// detection", IJCV 46(1), 2002, Tables 2 and 3), looked up in a table of 32 x 32 x 32 colours.
class SkinColor {
 public:
  SkinColor();

  /// log P(colour | skin) - log P(colour | not skin).
  float log_ratio(const Bgr& color) const { return table_[slot(color)]; }

 private:
  static std::size_t slot(const Bgr& color) {
    return static_cast<std::size_t>(color.r >> 3U) << 10U |
           static_cast<std::size_t>(color.g >> 3U) << 5U | static_cast<std::size_t>(color.b >> 3U);
  }
  std::array<float, 32768> table_;
};

}  // namespace limbcast::segmenter
