// SPDX-License-Identifier: BSD-3-Clause
// Planar scans: told from other ones, raised to walls, and kept in their plane.
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/filters/planar_scan.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {
using pcl6d::isInPlane;
using pcl6d::isPlanarScan;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::poseInPlane;
using pcl6d::raisedPlanarScan;

/** A room of 6 m x 4 m seen by a 2D scanner at a height. */
Points
room(std::size_t count, float height)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    const double c = std::cos(angle), s = std::sin(angle);
    const double range = std::min(3 / std::abs(c), 2 / std::abs(s));
    points.emplace_back(range * c, range * s, height);
  }
  return points;
}

Points
floorBelow(float height)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-3, 3);
  Points points;
  for (int i = 0; i < 2000; ++i)
    points.emplace_back(place(random), place(random), height);
  return points;
}
} // namespace

TEST(PlanarScan, IsToldAtAnyHeightAndInAnyOrder)
{
  for (const float height : {0.f, 0.3f, -1.2f}) {
    Points points = room(181, height);
    EXPECT_TRUE(isPlanarScan(points)) << height;
    std::shuffle(points.begin(), points.end(), std::mt19937(2));
    points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
    EXPECT_TRUE(isPlanarScan(points)) << height;
  }
}

TEST(PlanarScan, OtherScansAreNone)
{
  EXPECT_FALSE(isPlanarScan({}));
  EXPECT_FALSE(isPlanarScan(room(11, 0))) << "too few";
  EXPECT_FALSE(isPlanarScan(floorBelow(-1.5f))) << "an area at one height";
  Points ring = room(181, 0);
  for (auto& p : ring)
    p.z() = 0.035f * p.head<2>().norm(); // 2 degrees above
  EXPECT_FALSE(isPlanarScan(ring)) << "a cone";
  Points patch = floorBelow(0); // off to one side
  for (auto& p : patch)
    p.x() = 20 + p.x() / 2;
  EXPECT_FALSE(isPlanarScan(patch));
  Points two = room(181, 0);
  two.emplace_back(1, 1, 0.5f);
  EXPECT_FALSE(isPlanarScan(two)) << "one point elsewhere";
}

TEST(PlanarScan, RaisedItKeepsItsPointsAndHasRowsAndLedges)
{
  const Points points = room(90, 0.5f);
  const Points raised = raisedPlanarScan(points, 0.1);
  EXPECT_EQ(raised.size(), points.size() * (13 + 10));
  for (const auto& p : points)
    EXPECT_NE(std::find(raised.begin(), raised.end(), p), raised.end());
  const auto [low, high] =
      std::minmax_element(raised.begin(),
                          raised.end(),
                          [](const auto& a, const auto& b) { return a.z() < b.z(); });
  EXPECT_NEAR(low->z(), -0.1f, 1e-5f);
  EXPECT_NEAR(high->z(), 1.1f, 1e-5f);
}

TEST(PlanarScan, RaisingLeavesOutWhatIsNotFiniteAndLedgesBehindTheScanner)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Points raised = raisedPlanarScan({{0.25f, 0, 0}, {nan, 1, 0}}, 0.1);
  EXPECT_EQ(raised.size(), 13U + 2); // at 0.15 m alone
  for (const auto& p : raised)
    EXPECT_GT(p.x(), 0);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(raisedPlanarScan(room(90, 0), bad), pcl6d::BadArgument);
}

TEST(PlanarScan, APoseInThePlaneKeepsXYAndYaw)
{
  const Eigen::Isometry3d plane = poseFromEuler({3, -2, 1}, {0.3, -0.2, 2.5});
  const Eigen::Isometry3d in = poseFromEuler({4, 5, 0}, {0, 0, -1.3});
  EXPECT_TRUE(poseInPlane(plane, plane * in).isApprox(plane * in, 1e-12));
  const Eigen::Isometry3d off = in * poseFromEuler({0, 0, 0.05}, {0.02, -0.03, 0});
  const Eigen::Isometry3d back = plane.inverse() * poseInPlane(plane, plane * off);
  EXPECT_LT((back.translation() - in.translation()).norm(), 1e-12);
  EXPECT_NEAR(back.linear().col(2).z(), 1, 1e-12);
  EXPECT_TRUE(back.linear().isApprox(in.linear(), 2e-3)); // of second order
  const Eigen::Isometry3d there = plane * back;
  EXPECT_EQ(poseInPlane(plane, there).matrix(), there.matrix()) << "the same bits";
  const Eigen::Isometry3d over = plane * poseFromEuler({0, 0, 0}, {M_PI, 0, 0});
  EXPECT_TRUE(poseInPlane(plane, over).isApprox(plane, 1e-9)) << "has no yaw";
}

TEST(PlanarScan, PosesThatClimbOrTiltLeaveThePlane)
{
  const Eigen::Isometry3d plane = poseFromEuler({3, -2, 1}, {0, 0, 2.5});
  EXPECT_TRUE(isInPlane(plane, plane));
  EXPECT_TRUE(isInPlane(plane, plane * poseFromEuler({9, 2, 0.3}, {0.03, 0.02, 3})));
  EXPECT_FALSE(isInPlane(plane, plane * poseFromEuler({1, 0, 0.3}, {0, 0, 0})));
  EXPECT_FALSE(isInPlane(plane, plane * poseFromEuler({9, 0, 0}, {0.2, 0, 0})));
  EXPECT_FALSE(isInPlane(plane, plane * poseFromEuler({9, 0, 0}, {M_PI, 0, 0})));
}
