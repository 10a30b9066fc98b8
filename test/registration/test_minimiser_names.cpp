// SPDX-License-Identifier: BSD-3-Clause
#include "support/pairs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/registration/minimisers.h>
#include <pcl6d/registration/plane_minimiser.h>

#include <gtest/gtest.h>

using pcl6d::Random;
using pcl6d::test::movedPairs;
using pcl6d::test::randomPoints;
using pcl6d::test::randomPose;

TEST(MinimiserFromName, KnowsTheNamesOfTheCommandLine)
{
  const std::vector<std::string> names{"svd",
                                       "quaternion",
                                       "orthonormal",
                                       "dual-quaternion",
                                       "scale-quaternion",
                                       "helix",
                                       "small-angle",
                                       "euler",
                                       "quaternion-linear"};
  EXPECT_EQ(pcl6d::minimiserNames(), names);
  Random random(11);
  const auto sums =
      movedPairs(randomPoints(random, 9, 10), randomPose(random, 1, 0.5), random)
          .sums();
  for (const auto& minimiser : pcl6d::namedMinimisers())
    EXPECT_EQ(pcl6d::minimiserFromName(minimiser.name)(sums).transform.matrix(),
              minimiser.step(sums).transform.matrix());
}

TEST(MinimiserFromName, NamesAllWhenThereIsNoSuchOne)
{
  try {
    pcl6d::minimiserFromName("horn");
    ADD_FAILURE() << "no exception";
  } catch (const pcl6d::BadArgument& e) {
    EXPECT_STREQ(e.what(),
                 "minimiser = horn, but must be svd|quaternion|orthonormal|"
                 "dual-quaternion|scale-quaternion|helix|small-angle|euler|"
                 "quaternion-linear");
  }
}

TEST(PlaneMinimiserFromName, NamesAllWhenThereIsNoSuchOne)
{
  EXPECT_EQ(pcl6d::planeMinimiserNames(),
            (std::vector<std::string>{"linear", "helix"}));
  try {
    pcl6d::planeMinimiserFromName("lls");
    ADD_FAILURE() << "no exception";
  } catch (const pcl6d::BadArgument& e) {
    EXPECT_STREQ(e.what(), "plane minimiser = lls, but must be linear|helix");
  }
}
