// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * Marks of hot functions. PCL6D_SIMD_CLONES: one source, two machine codes, whereof the
 * CPU takes its own when the program starts. Both give the same bits, as the project
 * forbids fused multiply-add and everything else is done lane by lane.
 * PCL6D_SIMD_CLONES_FOR(...): the same for other architectures. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                 \
    !defined(__SANITIZE_THREAD__) // which is not ready where the choice is made
#define PCL6D_SIMD_CLONES_FOR(...) __attribute__((target_clones(__VA_ARGS__)))
#else
#define PCL6D_SIMD_CLONES_FOR(...)
#endif
#define PCL6D_SIMD_CLONES PCL6D_SIMD_CLONES_FOR("arch=x86-64-v3", "default")

/** What a clone calls must become part of it. */
#define PCL6D_INLINE __attribute__((always_inline)) inline
