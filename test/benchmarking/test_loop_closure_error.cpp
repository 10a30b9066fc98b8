// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories.h"

#include <pcl6d/benchmarking/loop_closure_error.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::BadArgument;
using pcl6d::findRevisits;
using pcl6d::Revisit;
using pcl6d::Trajectory;
using pcl6d::test::allPairs;
using pcl6d::test::kAngleTol;
using pcl6d::test::kPositionTol;

namespace {
/** Around a square of 10 m, a pose per metre, and two metres on: rows 40, 41 and 42 are
 * those of rows 0, 1 and 2. */
Trajectory
aroundTheBlock()
{
  Trajectory drive;
  for (int i = 0; i < 43; ++i) {
    const int side = i / 10 % 4, along = i % 10;
    const double yaw = side * M_PI / 2;
    const Eigen::Vector3d corner(
        side == 1 || side == 2 ? 10 : 0, side >= 2 ? 10 : 0, 0);
    drive.poses.push_back(pcl6d::poseFromEuler(corner, {0, 0, yaw}) *
                          pcl6d::planarPose(along, 0, 0));
  }
  return drive;
}
} // namespace

TEST(FindRevisits, GivesThePlacesWhereTheDriveComesBack)
{
  const auto drive = aroundTheBlock();
  EXPECT_EQ(findRevisits(drive, allPairs(43), {0.5, 20}),
            (std::vector<Revisit>{{0, 40}, {1, 41}, {2, 42}}));
  EXPECT_EQ(findRevisits(drive, allPairs(43), {0.5, 41}).size(), 0u);
  // 39 m on it is 1 m before the start: within 1 m, row 39 sees row 0 too.
  EXPECT_EQ(findRevisits(drive, allPairs(43), {1, 20}).front(), Revisit(0, 39));
}

TEST(FindRevisits, TakesTheNearestEarlierPose)
{
  auto drive = aroundTheBlock();
  drive.poses[41].translation().x() += 0.6; // at 1.6: nearer to row 2 than to row 1
  const auto revisits = findRevisits(drive, allPairs(43), {0.9, 20});
  EXPECT_EQ(revisits[1], Revisit(2, 41));
}

TEST(LoopClosureErrors, AreTheGapOfAnOpenLoop)
{
  const auto reference = aroundTheBlock();
  const auto pairs = allPairs(43);
  auto estimate = reference;
  const auto drift = pcl6d::planarPose(0.3, -0.4, 0.1);
  for (std::size_t i = 30; i < 43; ++i) // a slip before row 30, in its own frame
    estimate.poses[i] = reference.poses[29] * drift * reference.poses[29].inverse() *
                        reference.poses[i];
  const auto revisits = findRevisits(reference, pairs, {0.5, 20});
  const auto errors = loopClosureErrors(estimate, reference, pairs, revisits);
  ASSERT_EQ(errors.motions.size(), 3u);
  EXPECT_NEAR(errors.rotation.max, 0.1, kAngleTol);
  EXPECT_NEAR(errors.motions[0].path, 40, kPositionTol);
  // What is left at row 0 and 40, by hand: T_29 D T_29^-1 seen from the origin.
  const Eigen::Isometry3d slip =
      reference.poses[29] * drift * reference.poses[29].inverse();
  EXPECT_NEAR(errors.motions[0].translation, slip.translation().norm(), kPositionTol);
  EXPECT_EQ(loopClosureErrors(reference, reference, pairs, revisits).translation.max,
            0);
}

TEST(RevisitsOf, TakesIndicesOfTheReference)
{
  const std::vector<pcl6d::PosePair> pairs{{0, 3}, {1, 5}, {2, 9}};
  EXPECT_EQ(pcl6d::revisitsOf({{9, 3}, {3, 5}}, pairs),
            (std::vector<Revisit>{{0, 2}, {0, 1}}));
  EXPECT_THROW(pcl6d::revisitsOf({{3, 4}}, pairs), BadArgument);
  EXPECT_THROW(pcl6d::revisitsOf({{3, 3}}, pairs), BadArgument);
}

TEST(FindRevisits, RefusesBrokenOptions)
{
  const auto drive = aroundTheBlock();
  for (const double bad : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(findRevisits(drive, allPairs(3), {bad, 1}), BadArgument);
  EXPECT_THROW(findRevisits(drive, allPairs(3), {1, -1}), BadArgument);
  EXPECT_THROW(findRevisits(drive, allPairs(44)), BadArgument);
  EXPECT_THROW(loopClosureErrors(drive, drive, allPairs(3), {{0, 3}}), BadArgument);
}
