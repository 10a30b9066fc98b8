// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/components.h>

#include <gtest/gtest.h>

using pcl6d::Components;

TEST(Components, AreNamedByTheirFirstVertex)
{
  Components components(6);
  EXPECT_EQ(components.firsts(), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  components.join(5, 3);
  components.join(4, 5);
  components.join(2, 1);
  EXPECT_EQ(components.firsts(), (std::vector<std::size_t>{0, 1, 1, 3, 3, 3}));
  components.join(4, 0);
  EXPECT_EQ(components.firstOf(5), 0u);
  EXPECT_EQ(components.firsts(), (std::vector<std::size_t>{0, 1, 1, 0, 0, 0}));
}

TEST(Components, TellWhenAnEdgeClosesACycle)
{
  Components components(4);
  EXPECT_TRUE(components.join(0, 1));
  EXPECT_TRUE(components.join(2, 3));
  EXPECT_TRUE(components.join(1, 2));
  EXPECT_FALSE(components.join(3, 0));
  EXPECT_FALSE(components.join(1, 1));
}
