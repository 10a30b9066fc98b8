// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <gtest/gtest.h>

#include <limits>

TEST(PlaneCloud, LeavesOutWhatIsNotFiniteAndKnowsThePlaceOfTheRest)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  pcl6d::Points points{{nan, 0, 0}};
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      points.emplace_back(0.1f * x, 0.1f * y, 2.f);
  const pcl6d::PlaneCloud cloud(points);
  ASSERT_EQ(cloud.points().size(), 100u);
  EXPECT_EQ(cloud.places().front(), 1u);
  EXPECT_EQ(cloud.places().back(), 100u);
  ASSERT_EQ(cloud.normals().size(), 100u);
  EXPECT_NEAR(cloud.normals()[42].z(), -1.f, 1e-6); // towards the scanner
}
