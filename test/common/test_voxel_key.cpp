// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/voxel_key.h>

#include <gtest/gtest.h>

#include <limits>

TEST(VoxelKey, CentreLiesWithinHalfAVoxelAndHasTheSameKey)
{
  constexpr double kVoxel = 0.1;
  pcl6d::Random random(1);
  for (const auto& p : pcl6d::test::randomCube(random, 1000, 100)) {
    const auto key = pcl6d::voxelKey(p, kVoxel);
    const Eigen::Vector3f centre = pcl6d::voxelCentre(key, kVoxel);
    EXPECT_LE((centre - p).cwiseAbs().maxCoeff(), kVoxel / 2 + 1e-5); // float at 50 m
    EXPECT_EQ(pcl6d::voxelKey(centre, kVoxel), key);
  }
}

TEST(VoxelKey, SeparatesTheCellsOnBothSidesOfTheOrigin)
{
  EXPECT_NE(pcl6d::voxelKey({0.01f, 0, 0}, 0.1), pcl6d::voxelKey({-0.01f, 0, 0}, 0.1));
}

TEST(VoxelKey, OfTwiceTheEdgeFollowsFromTheKey)
{
  constexpr double kVoxel = 0.1;
  pcl6d::Random random(2);
  for (const auto& p : pcl6d::test::randomCube(random, 1000, 1000)) {
    pcl6d::VoxelKey key = pcl6d::voxelKey(p, kVoxel);
    for (const double edge : {2 * kVoxel, 4 * kVoxel, 8 * kVoxel}) {
      key = pcl6d::coarserVoxel(key);
      EXPECT_EQ(key, pcl6d::voxelKey(p, edge)) << p.transpose() << ", edge " << edge;
    }
  }
}

TEST(VoxelKey, RefusesWhatDoesNotFitInsteadOfWrappingAround)
{
  EXPECT_NO_THROW(pcl6d::voxelKey({104000, 0, 0}, 0.1));
  EXPECT_THROW(pcl6d::voxelKey({105000, 0, 0}, 0.1), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::voxelKey({0, 0, -105000}, 0.1), pcl6d::BadArgument);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(pcl6d::voxelKey({0, nan, 0}, 0.1), pcl6d::BadArgument);
}
