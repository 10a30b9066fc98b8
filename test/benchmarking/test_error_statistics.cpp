// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

TEST(ErrorStatistics, AreThoseComputedByHand)
{
  const auto odd = pcl6d::errorStatistics({3, 0, 6});
  EXPECT_EQ(odd.count, 3u);
  EXPECT_DOUBLE_EQ(odd.rms, std::sqrt(15.0));
  EXPECT_DOUBLE_EQ(odd.mean, 3);
  EXPECT_DOUBLE_EQ(odd.median, 3);
  EXPECT_DOUBLE_EQ(odd.max, 6);
  EXPECT_EQ(odd.index_of_max, 2u);

  const auto even = pcl6d::errorStatistics({7, 1, 2, 7});
  EXPECT_DOUBLE_EQ(even.median, 4.5);
  EXPECT_EQ(even.index_of_max, 0u) << "the first of equals";
}

TEST(ErrorStatistics, OfNothingAreZero)
{
  const auto none = pcl6d::errorStatistics({});
  EXPECT_EQ(none.count, 0u);
  EXPECT_EQ(none.rms, 0);
  EXPECT_EQ(none.max, 0);
}

TEST(ErrorStatistics, RefuseValuesThatAreNoErrors)
{
  EXPECT_THROW(pcl6d::errorStatistics({1, -1}), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::errorStatistics({std::numeric_limits<double>::quiet_NaN()}),
               pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::errorStatistics({std::numeric_limits<double>::infinity()}),
               pcl6d::BadArgument);
}
