// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl6d::test {

constexpr std::size_t kRigidPairs = 50;

constexpr double kRigidHalf = 10; // [m] half side of the cube that holds the points

constexpr double kExtent = 20; // [m] largest component of a translation

constexpr double kAngleTol = 6e-13; // [rad]

constexpr double kPositionTol = kAngleTol * 60; // [m] lever arm of |d| + |t|

} // namespace pcl6d::test
