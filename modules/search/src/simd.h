// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/simd_clones.h>

#include <cstdint>
#include <cstring>

/** \file
 * Vectors of four and eight lanes. */
namespace pcl6d::search {

using Vector4 = float __attribute__((vector_size(16)));
using Vector8 = float __attribute__((vector_size(32)));
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

} // namespace pcl6d::search
