// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/moving_objects/point_motion.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {

TEST(PointMotion, HasAWordForEachAnswer)
{
  EXPECT_STREQ(toString(PointMotion::kUnknown), "unknown");
  EXPECT_STREQ(toString(PointMotion::kStatic), "static");
  EXPECT_STREQ(toString(PointMotion::kDynamic), "dynamic");
}

} // namespace
} // namespace pcl6d
