// SPDX-License-Identifier: BSD-3-Clause
#include "network_scans.h"

#include <pcl6d/graph_relaxation/scan_link.h>

#include <gtest/gtest.h>

using pcl6d::IcpModel;
using pcl6d::NetworkScan;
using pcl6d::Points;
using pcl6d::PointVotes;
using pcl6d::Poses;
using pcl6d::ScanPair;
using pcl6d::test::NetworkScans;
using pcl6d::test::shifted;

namespace {
const Eigen::Isometry3d kHere = Eigen::Isometry3d::Identity();

/** A sphere of points about the origin: range [m] in all directions. */
Points
sphere(double range)
{
  Points points;
  pcl6d::Random random(1);
  for (int i = 0; i < 20000; ++i)
    points.push_back(
        (range * Eigen::Vector3d(random.normal(), random.normal(), random.normal())
                     .normalized())
            .cast<float>());
  return points;
}

/** Points on a line along x, a metre apart. */
Points
row(int count)
{
  Points points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(static_cast<float>(i), 0.f, 0.f);
  return points;
}
} // namespace

TEST(NetworkScan, HasTheMiddleAndTheReachOfItsPoints)
{
  const IcpModel model({{1, 0, 0}, {5, 0, 0}, {3, 1, 0}, {3, -1, 0}}, {});
  const NetworkScan scan(model);
  EXPECT_TRUE(scan.centre().isApprox(Eigen::Vector3d(3, 0, 0)));
  EXPECT_DOUBLE_EQ(scan.radius(), 2);
  EXPECT_EQ(&scan.model(), &model);
}

TEST(PointVotes, ShareIsNearLessEmpty)
{
  PointVotes votes{10, 7, 2};
  EXPECT_DOUBLE_EQ(votes.share(), 0.5);
  votes += {10, 0, 10};
  EXPECT_EQ(votes.points, 20u);
  EXPECT_EQ(votes.near, 7u);
  EXPECT_EQ(votes.empty, 12u);
  EXPECT_DOUBLE_EQ(votes.share(), -0.25);
  EXPECT_EQ(PointVotes().share(), 0);
}

TEST(VotesOf, TellsPointsThatAreNearFromThoseLookedThrough)
{
  // Seen from the middle of a sphere of 5 m: points on it are near, points at 2 m lie
  // where the scan looked through, points at 9 m are hidden and say nothing.
  const IcpModel outer(sphere(5), {});
  Points points;
  for (int i = 0; i < 30; ++i) {
    const Points& on = outer.points();
    points.push_back(on[i] * (i < 10 ? 1.f : i < 24 ? 0.4f : 1.8f));
  }
  const IcpModel mixed(points, {});
  const NetworkScan scan(mixed), other(outer);
  const PointVotes votes = votesOf(scan, other, kHere, 0.1);
  EXPECT_EQ(votes.points, 30u);
  EXPECT_EQ(votes.near, 10u);
  EXPECT_EQ(votes.empty, 14u);
  EXPECT_EQ(votesOf(scan, other, kHere, 0.1, 7).points, 5u) << "0, 7, 14, 21, 28";
}

TEST(VotesOf, UsesThePoseOfTheScan)
{
  const IcpModel model(row(10), {});
  const NetworkScan scan(model);
  EXPECT_EQ(votesOf(scan, scan, kHere, 0.1).near, 10u);
  EXPECT_EQ(votesOf(scan, scan, shifted(3), 0.1).near, 7u);
  EXPECT_EQ(votesOf(scan, scan, shifted(3.5), 0.1).near, 0u);
}

TEST(VotesOf, SaysNothingOfAScanThatIsBeyondAllNumbers)
{
  // Places that are too far for float, or no numbers at all.
  const IcpModel model(sphere(5), {});
  const NetworkScan scan(model);
  for (const double far : {1e19, 1e30, 1e100, 1e300})
    for (const double sign : {-1.0, 1.0}) {
      const PointVotes votes = votesOf(scan, scan, shifted(sign * far), 0.1, 100);
      EXPECT_EQ(votes.points, 200u);
      EXPECT_EQ(votes.near, 0u);
      EXPECT_EQ(votes.empty, 0u);
      EXPECT_EQ(overlapOf(scan, scan, shifted(sign * far), 0.1), 0);
    }
}

TEST(VotesOf, LooksThroughAtMoreThanTwoDistances)
{
  const IcpModel outer(sphere(5), {});
  const NetworkScan other(outer);
  const auto empty = [&](float range, double distance) {
    Points points;
    for (int i = 0; i < 200; ++i)
      points.push_back(outer.points()[static_cast<std::size_t>(i)] * (range / 5));
    const IcpModel model(points, {});
    return votesOf(NetworkScan(model), other, kHere, distance).empty;
  };
  // Cells are 0.03 rad wide here: 9 cm at 3 m.
  EXPECT_EQ(empty(3.F, 0.9), 200u) << "2 m in front of the sphere";
  EXPECT_EQ(empty(3.F, 1.0), 0u);
}

TEST(OverlapOf, IsTheLargerShareOfBothWays)
{
  const IcpModel small(row(5), {}), large(row(20), {});
  const NetworkScan a(small), b(large);
  EXPECT_DOUBLE_EQ(overlapOf(a, b, kHere, 0.1), 1) << "all of a, a quarter of b";
  EXPECT_DOUBLE_EQ(overlapOf(b, a, kHere, 0.1), 1);
  EXPECT_DOUBLE_EQ(overlapOf(a, b, shifted(3), 0.1), 0.4) << "two points of a";
  EXPECT_DOUBLE_EQ(overlapOf(b, a, shifted(3), 0.1), 1) << "a lies within b";
  EXPECT_DOUBLE_EQ(overlapOf(b, a, shifted(100), 0.1), 0);
}

TEST(OverlappingPairs, FindsThoseAboveTheirOwnLimit)
{
  NetworkScans network;
  for (const double x : {0., 3., 8., 100.})
    network.add(row(10), shifted(x));
  // Shares: 0-1 0.7, 0-2 0.2, 1-2 0.5; the last one is alone.
  const auto pairs = [&](double limit, unsigned int threads) {
    return overlappingPairs(
        network.scans,
        network.truth,
        0.1,
        [limit](const ScanPair& pair) {
          return pair == ScanPair{0, 1} ? 0.71 : limit;
        },
        threads);
  };
  EXPECT_EQ(pairs(0.2, 1), (std::vector<ScanPair>{{0, 2}, {1, 2}}));
  EXPECT_EQ(pairs(0.21, 1), (std::vector<ScanPair>{{1, 2}}));
  EXPECT_EQ(pairs(0.51, 1), std::vector<ScanPair>{});
  for (const unsigned int threads : {0u, 2u, 8u})
    EXPECT_EQ(pairs(0.2, threads), pairs(0.2, 1));
}

TEST(ScanLink, KindsAndVerdictsHaveNames)
{
  using pcl6d::LinkKind;
  using pcl6d::LinkVerdict;
  EXPECT_STREQ(toString(LinkKind::kSequence), "sequence");
  EXPECT_STREQ(toString(LinkKind::kNetwork), "network");
  EXPECT_STREQ(toString(LinkKind::kLoop), "loop");
  EXPECT_STREQ(toString(LinkKind::kGiven), "given");
  EXPECT_STREQ(toString(LinkVerdict::kUsed), "used");
  EXPECT_STREQ(toString(LinkVerdict::kOdometry), "odometry");
  EXPECT_STREQ(toString(LinkVerdict::kRefused), "refused");
}
