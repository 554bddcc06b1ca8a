#pragma once

/// Before a function whose loops the compiler is to vectorise: on x86-64 also builds it for AVX2
/// and takes that one at run time where the processor has it. Elsewhere the baseline's vectors
/// (arm64: NEON) serve.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define LIMBCAST_SIMD __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define LIMBCAST_SIMD
#endif
