// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/simd_clones.h>

#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

/** \file
 * Vectors of four and eight lanes. */
namespace pcl6d::search {

using Vector4 = float __attribute__((vector_size(16)));
using Vector8 = float __attribute__((vector_size(32)));
using Doubles4 = double __attribute__((vector_size(32)));
using Bits8 = std::int32_t __attribute__((vector_size(32)));

template <typename Vector, typename Scalar>
PCL6D_INLINE void
load(Vector& v, const Scalar* from)
{
  std::memcpy(&v, from, sizeof(v));
}

template <typename Vector, typename Scalar>
PCL6D_INLINE void
store(Scalar* to, const Vector& v)
{
  std::memcpy(to, &v, sizeof(v));
}

PCL6D_INLINE float
smallest(const Vector8& v)
{
  const Vector4 a{v[0], v[1], v[2], v[3]}, b{v[4], v[5], v[6], v[7]};
  const Vector4 four = a < b ? a : b;
  const Vector4 crossed{four[2], four[3], four[0], four[1]};
  const Vector4 two = four < crossed ? four : crossed;
  return two[0] < two[1] ? two[0] : two[1];
}

/** \return a bit for each true lane (-1); the first lane is the lowest bit */
PCL6D_INLINE unsigned int
bitsOf(const Bits8& truth)
{
#ifdef __SSE2__
  __m128 low, high;
  std::memcpy(&low, &truth, sizeof(low));
  std::memcpy(&high, reinterpret_cast<const char*>(&truth) + sizeof(low), sizeof(high));
  return static_cast<unsigned int>(_mm_movemask_ps(low) | (_mm_movemask_ps(high) << 4));
#else
  unsigned int bits = 0;
  for (unsigned int i = 0; i < 8; ++i)
    bits |= truth[i] != 0 ? 1U << i : 0U;
  return bits;
#endif
}

} // namespace pcl6d::search
