#pragma once

#include <vector>

namespace limbcast::segmenter {

/// What computes networks.
enum class NetworkLibrary {
  /// Google's, in 32 bits: quick on every processor, and gives nearly the same numbers on each.
  kXnnpack,
  /// Intel's: in brain floats of 16 bits, for processors that compute with them (AVX512_BF16: AMD
  /// since Zen 4; AMX), where it takes half the time. On others it is no quicker.
  kOneDnn
};

/// Those that this processor has kernels for, the quickest first.
std::vector<NetworkLibrary> network_libraries();

}  // namespace limbcast::segmenter
