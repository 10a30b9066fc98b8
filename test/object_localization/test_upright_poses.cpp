// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/localization_cases.h"
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/upright_poses.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
namespace {
constexpr double kStep = 5 * M_PI / 180; // [rad] of headings
constexpr double kCell = 0.015;          // [m]

Eigen::AlignedBox3d
boxOf(const Points& points)
{
  Eigen::AlignedBox3d box;
  for (const auto& p : points)
    box.extend(p.cast<double>());
  return box;
}

/** The points of a placed surface that face the origin. */
Points
seenFromOrigin(const OrientedPoints& surface)
{
  Points seen;
  for (std::size_t i = 0; i < surface.size(); ++i)
    if (surface.points[i].dot(surface.normals[i]) < 0)
      seen.push_back(surface.points[i]);
  return seen;
}

/** On a support that is itself tilted in the scene. */
const Eigen::Isometry3d kBase = poseFromEuler({1.5, 0.4, -0.7}, {0.1, -0.2, 0.9});
} // namespace

TEST(DistanceField, IsThatOfBruteForce)
{
  Random random(1);
  const Points points = test::randomCube(random, 40, 1);
  constexpr double kReach = 0.12, kWidth = 0.05;
  const DistanceField field(points, kWidth, kReach);
  EXPECT_EQ(field.reach(), kReach);
  EXPECT_EQ(field.cell(), kWidth);
  const Eigen::Vector3d origin =
      boxOf(points).min() - Eigen::Vector3d::Constant(kReach);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d cell(
        random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 20));
    const Eigen::Vector3d middle =
        origin + kWidth * (cell.array().floor() + 0.5).matrix();
    double nearest = kReach;
    for (const auto& p : points)
      nearest = std::min(nearest, (p.cast<double>() - middle).norm());
    EXPECT_NEAR(field.at(origin + kWidth * cell), nearest, 1e-6);
  }
  EXPECT_EQ(field.at({9, 0, 0}), kReach);
  EXPECT_EQ(field.at({0, 0, -9}), kReach);
}

TEST(DistanceField, RefusesBadArguments)
{
  const Points one = {{0, 0, 0}};
  EXPECT_THROW(DistanceField({}, 0.1, 0.3), BadArgument);
  EXPECT_THROW(DistanceField(one, 0, 0.3), BadArgument);
  EXPECT_THROW(DistanceField(one, 0.1, 0.1), BadArgument);
  EXPECT_THROW(DistanceField(one, 0.1, INFINITY), BadArgument);
  EXPECT_THROW(DistanceField({{0, 0, 0}, {1e9F, 1e9F, 1e9F}}, 0.1, 0.3), BadArgument);
}

TEST(DistanceField, IsFarFromWhatIsNoPlace)
{
  const DistanceField field({{0, 0, 0}}, 0.1, 0.3);
  for (const double far : {1e12, 1e300, double{INFINITY}, std::nan("")})
    EXPECT_EQ(field.at({far, 0, 0}), 0.3) << far;
}

TEST(UprightPoses, FindAPlacedModelAgain)
{
  const OrientedPoints model = test::machineSurface(0.01);
  const DistanceField field(model.points, kCell, 3 * kCell);
  for (const double yaw : {0.0, 0.7, 2.4, -1.9}) {
    Eigen::Isometry3d T_base_model = planarPose(0.3, -0.2, yaw);
    const Eigen::Isometry3d truth = kBase * T_base_model;
    const auto poses = uprightPoses(field,
                                    boxOf(model.points),
                                    {1},
                                    seenFromOrigin(test::moved(model, truth)),
                                    kBase,
                                    5);
    ASSERT_EQ(poses.size(), 5u);
    const MotionSize off = distanceBetween(truth, poses[0].T_scene_model);
    EXPECT_LT(off.translation, 1.5 * kCell) << yaw;
    EXPECT_LE(off.rotation, kStep + 1e-9) << yaw;
    EXPECT_GT(poses[0].votes, 0.8);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LE(poses[i].votes, poses[i == 0 ? 0 : i - 1].votes);
      // Upright on the support.
      const Eigen::Isometry3d T = kBase.inverse() * poses[i].T_scene_model;
      EXPECT_NEAR(T.translation().z(), 0, 1e-9);
      EXPECT_LT((T.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
    }
  }
}

TEST(UprightPoses, TryOnlyHeadingsThatLookDifferent)
{
  const OrientedPoints model = test::machineSurface(0.01);
  const DistanceField field(model.points, kCell, 3 * kCell);
  const Points seen = seenFromOrigin(test::moved(model, kBase));
  const auto headingOf = [](const VotedPose& pose) {
    return eulerFromRotation(kBase.linear().transpose() * pose.T_scene_model.linear())
        .yaw;
  };
  for (const auto& pose :
       uprightPoses(field, boxOf(model.points), {0}, seen, kBase, 20))
    EXPECT_NEAR(headingOf(pose), 0, 1e-9);
  for (const auto& pose :
       uprightPoses(field, boxOf(model.points), {4}, seen, kBase, 20)) {
    EXPECT_GT(headingOf(pose), -1e-9);
    EXPECT_LT(headingOf(pose), M_PI / 2 - 1e-9);
  }
}

TEST(UprightPoses, GiveNothingForNothing)
{
  const OrientedPoints model = test::machineSurface(0.02);
  const DistanceField field(model.points, kCell, 3 * kCell);
  EXPECT_TRUE(uprightPoses(field, boxOf(model.points), {1}, {}, kBase, 5).empty());
  EXPECT_TRUE(
      uprightPoses(field, boxOf(model.points), {1}, model.points, kBase, 0).empty());
}

} // namespace pcl6d
