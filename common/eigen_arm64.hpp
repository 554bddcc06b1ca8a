#pragma once

// Included before all else on arm64 (CMakeLists.txt). There Eigen has registers of two floats, too,
// and takes them for the first two of a Vector3f: it adds the three in another order than on
// x86-64, and heads are seen a rounding elsewhere. With the usual register alone sums are the same.
#if __has_include(<Eigen/Core>)
#include <Eigen/Core>

namespace Eigen::internal {

template <int Size>
struct find_best_packet<float, Size> {
  using type = packet_traits<float>::type;
};

}  // namespace Eigen::internal
#endif
