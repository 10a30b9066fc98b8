// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file Marks of hot functions. PCL6D_SIMD_CLONES: a function is compiled for two instruction
 * sets, and the CPU's version is chosen at program start. Both versions give equal bits: the
 * project forbids fused multiply-add, and the remaining operations are lane by lane.
 * PCL6D_SIMD_CLONES_FOR(...): for further architectures. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                 \
    !defined(__SANITIZE_THREAD__) // the sanitizer starts after the choice
#define PCL6D_SIMD_CLONES_FOR(...) __attribute__((target_clones(__VA_ARGS__)))
#else
#define PCL6D_SIMD_CLONES_FOR(...)
#endif
#define PCL6D_SIMD_CLONES PCL6D_SIMD_CLONES_FOR("arch=x86-64-v3", "default")

/** Functions called by a clone must be inlined into the clone. */
#define PCL6D_INLINE __attribute__((always_inline)) inline
