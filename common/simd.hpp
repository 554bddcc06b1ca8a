#pragma once

#include <cstdint>
#include <cstring>

/// Before a function whose loops the compiler is to vectorise: on x86-64 also builds it for AVX2
/// and takes that one at run time where the processor has it. Elsewhere the baseline's vectors
/// (arm64: NEON) serve.
/// LIMBCAST_BIT_COUNTING_SIMD is for a function that counts the bits of vectors' bytes, and is to
/// be called where counts_bits_of_vectors() only.
/// LIMBCAST_INLINE is for what such functions call in their loops, and for lambdas there.
#define LIMBCAST_INLINE __attribute__((always_inline))
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define LIMBCAST_SIMD __attribute__((target_clones("avx2", "default"), optimize("O3")))
#define LIMBCAST_BIT_COUNTING_SIMD \
  __attribute__((target("avx512bitalg,avx512vl,avx512bw"), optimize("O3")))
#else
#define LIMBCAST_SIMD
#define LIMBCAST_BIT_COUNTING_SIMD
#endif

/// Before a loop whose rounds do not read what others write.
#if defined(__clang__)
#define LIMBCAST_INDEPENDENT_ROUNDS _Pragma("clang loop vectorize(assume_safety)")
#else
#define LIMBCAST_INDEPENDENT_ROUNDS _Pragma("GCC ivdep")
#endif

namespace limbcast {

/// Eight numbers worked on lane by lane; where vectors are narrower the compiler takes several. Not
/// by value through functions that are no LIMBCAST_SIMD: how they are passed depends on the
/// vectors.
using Float8 = float __attribute__((vector_size(32), may_alias));
using Int8 = std::int32_t __attribute__((vector_size(32), may_alias));

/// From or to any address.
template <class Number, class Lanes>
void load(const Number* from, Lanes& lanes) {
  static_assert(sizeof(lanes[0]) == sizeof(Number));
  std::memcpy(&lanes, from, sizeof(lanes));
}
template <class Lanes, class Number>
void store(const Lanes& lanes, Number* to) {
  static_assert(sizeof(lanes[0]) == sizeof(Number));
  std::memcpy(to, &lanes, sizeof(lanes));
}

inline bool counts_bits_of_vectors() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  return __builtin_cpu_supports("avx512bitalg") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
         __builtin_cpu_supports("avx512bw") != 0;
#else
  return true;
#endif
}

}  // namespace limbcast
