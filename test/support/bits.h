// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstring>

namespace pcl6d::test {

/** \return whether two matrices have the same bits; NaN equals itself */
template <typename Matrix>
bool
sameBits(const Matrix& a, const Matrix& b)
{
  return std::memcmp(a.data(), b.data(), sizeof(*a.data()) * a.size()) == 0;
}

inline bool
sameBits(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  return sameBits(a.matrix(), b.matrix());
}

} // namespace pcl6d::test
