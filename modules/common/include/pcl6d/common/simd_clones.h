// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * Marks of hot functions. PCL6D_SIMD_CLONES: one source, two machine codes, whereof the
 * CPU takes its own when the program starts. Both give the same bits, as the project
 * forbids fused multiply-add and everything else is done lane by lane. */
#ifndef PCL6D_SIMD_CLONES
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PCL6D_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define PCL6D_SIMD_CLONES
#endif
#endif

/** What a clone calls must become part of it. */
#define PCL6D_INLINE __attribute__((always_inline)) inline
