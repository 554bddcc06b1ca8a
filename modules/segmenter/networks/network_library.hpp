#pragma once

#include <vector>

namespace limbcast::segmenter {

/// What computes networks.
enum class NetworkLibrary {
  /// Google's, in 32 bits: quick on every processor, and gives nearly the same numbers on each.
  kXnnpack,
  /// Intel's, where it takes half the time: in brain floats of 16 bits on processors that compute
  /// with them (AVX512_BF16: AMD since Zen 4; AMX), in 32 bits on those with AVX2 alone.
  kOneDnn
};

/// Those that this processor has kernels for, the quickest first.
std::vector<NetworkLibrary> network_libraries();

}  // namespace limbcast::segmenter
