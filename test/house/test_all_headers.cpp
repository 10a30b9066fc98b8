// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

// In the translation units that CMake makes of all public headers.
int
allHeaders_forwards();
int
allHeaders_backwards();

TEST(AllHeaders, StandTogetherInBothOrders)
{
  EXPECT_EQ(allHeaders_forwards() + allHeaders_backwards(), 2);
}
