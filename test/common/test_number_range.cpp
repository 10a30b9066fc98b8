// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

TEST(NumberRange, CastsAreDefinedForEveryNumber)
{
  using pcl6d::clampedTo;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(clampedTo<int>(-2.9), -2);
  EXPECT_EQ(clampedTo<int>(1e100), std::numeric_limits<int>::max());
  EXPECT_EQ(clampedTo<int>(-kInfinity), std::numeric_limits<int>::min());
  EXPECT_EQ(clampedTo<int>(2147483647.5), std::numeric_limits<int>::max());
  EXPECT_EQ(clampedTo<int>(-2147483648.0), std::numeric_limits<int>::min());
  EXPECT_EQ(clampedTo<int>(std::nan("")), 0);
  EXPECT_EQ(clampedTo<std::int64_t>(9.3e18), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(clampedTo<std::int64_t>(-9.3e18), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(clampedTo<std::size_t>(-1), 0u);
  EXPECT_EQ(clampedTo<std::size_t>(1.9e19), std::numeric_limits<std::size_t>::max());
  EXPECT_EQ(clampedTo<unsigned char>(255.5), 255);
}

TEST(NumberRange, PlacesAreFiniteAndNear)
{
  using pcl6d::isPlace;
  EXPECT_TRUE(isPlace(Eigen::Vector3d(9.9e8, -9.9e8, 0)));
  EXPECT_FALSE(isPlace(Eigen::Vector3d(1e9, 0, 0)));
  EXPECT_FALSE(isPlace(Eigen::Vector3f(0, 0, -1e30F)));
  EXPECT_FALSE(isPlace(Eigen::Vector3d(0, std::nan(""), 0)));
}
