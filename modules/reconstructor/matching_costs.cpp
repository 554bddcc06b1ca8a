#include "modules/reconstructor/matching_costs.hpp"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>

#include "common/simd.hpp"

namespace limbcast::reconstructor {
namespace {

using Byte = std::uint8_t;
using PlaneRows = std::array<const Byte*, Census::kNumPlanes>;

PlaneRows rows_of(const Census& census, int v) {
  PlaneRows rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = census.planes[i][v];
  return rows;
}

/// Set bits of each half of a byte.
inline Byte count_in_halves(Byte bits) {
  const auto pairs = static_cast<Byte>(bits - ((bits >> 1) & 0x55));
  return static_cast<Byte>((pairs & 0x33) + ((pairs >> 2) & 0x33));
}

/// Set bits of three bytes.
struct Adder {
  [[gnu::always_inline]] static Byte count(Byte x0, Byte x1, Byte x2) {
    // A full adder for each bit: three bits become a sum and a carry of twice the weight.
    const Byte either = x0 ^ x1;
    const Byte sum = count_in_halves(static_cast<Byte>(either ^ x2));
    const Byte carry = count_in_halves(static_cast<Byte>((x0 & x1) | (either & x2)));
    const auto halves = static_cast<Byte>(sum + carry + carry);
    return static_cast<Byte>((halves & 0x0f) + (halves >> 4));
  }
};

/// The same where the processor counts a vector's bits.
struct BitCounter {
  [[gnu::always_inline]] static Byte count(Byte x0, Byte x1, Byte x2) {
    return static_cast<Byte>(__builtin_popcount(x0) + __builtin_popcount(x1) +
                             __builtin_popcount(x2));
  }
};

template <class Counter>
LIMBCAST_INLINE inline void count_differing_bits(const PlaneRows& left,
                                                 const PlaneRows& right_mirrored, int width,
                                                 const Byte* background, const Byte* least,
                                                 const Byte* background_least, int num_registers,
                                                 Byte* __restrict costs) {
  with_size(num_registers, [&](auto size) LIMBCAST_INLINE {
    for (int u = 0; u < width; ++u) {
      const Byte l0 = left[0][u], l1 = left[1][u], l2 = left[2][u];
      const Byte* __restrict least_here = background[u] ? background_least : least;
      const int match = width - 1 - u;
      const Byte* __restrict r0 = right_mirrored[0] + match;
      const Byte* __restrict r1 = right_mirrored[1] + match;
      const Byte* __restrict r2 = right_mirrored[2] + match;
      Byte* __restrict costs_here = costs + static_cast<std::ptrdiff_t>(u) * size;
      for (int d = 0; d < size; ++d) {
        const Byte x0 = l0 ^ r0[d], x1 = l1 ^ r1[d], x2 = l2 ^ r2[d];
        costs_here[d] = std::max(Counter::count(x0, x1, x2), least_here[d]);
      }
    }
  });
}

LIMBCAST_SIMD void count_by_adding(const PlaneRows& left, const PlaneRows& right_mirrored,
                                   int width, const Byte* background, const Byte* least,
                                   const Byte* background_least, int num_registers, Byte* costs) {
  count_differing_bits<Adder>(left, right_mirrored, width, background, least, background_least,
                              num_registers, costs);
}

LIMBCAST_BIT_COUNTING_SIMD void count_by_instruction(const PlaneRows& left,
                                                     const PlaneRows& right_mirrored, int width,
                                                     const Byte* background, const Byte* least,
                                                     const Byte* background_least,
                                                     int num_registers, Byte* costs) {
  count_differing_bits<BitCounter>(left, right_mirrored, width, background, least, background_least,
                                   num_registers, costs);
}

}  // namespace

MatchingCosts::MatchingCosts(const cv::Mat1b& left, const cv::Mat1b& right, int num_disparities,
                             const EvenBackgroundParams& background)
    : left_(census_of(left)),
      right_mirrored_(census_of(right)),
      background_(even_background(left, left_, background)),
      least_(cv::alignSize(num_disparities, kCostsInARegister), kNoMatch),
      background_least_(least_) {
  std::fill_n(least_.begin(), num_disparities, Byte{0});
  for (int d = 0; d < num_disparities; ++d)
    background_least_[d] = static_cast<Byte>(std::min(d / background.px_per_bit, Census::kNumBits));
  for (cv::Mat1b& plane : right_mirrored_.planes) {
    cv::flip(plane, plane, 1);
    cv::copyMakeBorder(plane, plane, 0, 0, 0, size(), cv::BORDER_REPLICATE);
  }
}

void MatchingCosts::compute_row(int v, Byte* costs) const {
  static const auto count = counts_bits_of_vectors() ? count_by_instruction : count_by_adding;
  count(rows_of(left_, v), rows_of(right_mirrored_, v), left_.planes[0].cols, background_[v],
        least_.data(), background_least_.data(), size() / kCostsInARegister, costs);
}

}  // namespace limbcast::reconstructor
