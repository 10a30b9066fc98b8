// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/search/point_tree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using pcl6d::Neighbour;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;

namespace {
const float kInfinity = std::numeric_limits<float>::infinity();
const float kNan = std::numeric_limits<float>::quiet_NaN();

/** The oracle: all finite points nearer than the limit, sorted by distance, then index.
 */
std::vector<Neighbour>
bruteForce(const Points& points, const Eigen::Vector3f& q, float limit_sq)
{
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f d = q - points[i];
    const float sq = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    if (sq < limit_sq)
      found.push_back({static_cast<int>(i), sq});
  }
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance_sq < b.distance_sq ||
           (a.distance_sq == b.distance_sq && a.index < b.index);
  });
  return found;
}

void
expectEqual(const std::vector<Neighbour>& found, const std::vector<Neighbour>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].index, expected[i].index);
    EXPECT_EQ(found[i].distance_sq, expected[i].distance_sq);
  }
}

/** Points on an integer grid, each several times: as many ties as there can be. */
Points
gridWithDuplicates(Random& random, std::size_t count)
{
  Points points(count);
  for (auto& p : points)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = std::floor(static_cast<float>(random.uniform(0, 5)));
  return points;
}

void
expectAgreesWithBruteForce(const Points& points, const Points& queries)
{
  const PointTree tree(points, 2);
  for (const auto& q : queries)
    for (const float limit_sq : {0.01f, 1.0f, 25.0f, kInfinity}) {
      const auto expected = bruteForce(points, q, limit_sq);
      const Neighbour nearest = tree.nearest(q, limit_sq);
      EXPECT_EQ(nearest.index, expected.empty() ? -1 : expected[0].index);
      expectEqual(tree.withinRadius(q, limit_sq), expected);
      auto first = expected;
      first.resize(std::min<std::size_t>(first.size(), 7));
      expectEqual(tree.withinRadius(q, limit_sq, 7), first);
    }
}
} // namespace

TEST(PointTree, AgreesWithBruteForceOnRandomPoints)
{
  Random random(1);
  for (const std::size_t count : {1u, 2u, 8u, 9u, 17u, 1000u})
    expectAgreesWithBruteForce(pcl6d::test::randomCube(random, count, 10),
                               pcl6d::test::randomCube(random, 100, 14));
}

TEST(PointTree, ReturnsTheSmallestIndexAmongManyTies)
{
  Random random(2);
  const Points points = gridWithDuplicates(random, 1000);
  expectAgreesWithBruteForce(points, gridWithDuplicates(random, 100));
}

TEST(PointTree, BuildsFromManyEqualPoints)
{
  const Points points(1000, Eigen::Vector3f(1, 2, 3));
  const PointTree tree(points);
  EXPECT_EQ(tree.nearest({0, 0, 0}, kInfinity).index, 0);
  EXPECT_EQ(tree.withinRadius({1, 2, 3}, 1).size(), 1000u);
}

TEST(PointTree, FindsEachOfItsOwnPoints)
{
  Random random(3);
  const Points points = pcl6d::test::randomCube(random, 5000, 10);
  const PointTree tree(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(tree.nearest(points[i], 1e-9f).index, static_cast<int>(i));
}

TEST(PointTree, LeavesOutPointsThatAreNotFinite)
{
  const Points points{{kNan, 0, 0}, {1, 0, 0}, {0, kInfinity, 0}, {2, 0, 0}};
  const PointTree tree(points);
  EXPECT_EQ(tree.size(), 2u);
  EXPECT_EQ(tree.nearest({0, 0, 0}, kInfinity).index, 1);
  EXPECT_EQ(tree.nearestK({0, 0, 0}, 9).size(), 2u);
}

TEST(PointTree, FindsNothingWhereThereIsNothing)
{
  const PointTree empty;
  EXPECT_EQ(empty.nearest({0, 0, 0}, kInfinity).index, -1);
  EXPECT_TRUE(empty.nearestK({0, 0, 0}, 3).empty());
  const PointTree tree(Points{{1, 0, 0}});
  EXPECT_EQ(tree.nearest({kNan, 0, 0}, kInfinity).index, -1);
  EXPECT_EQ(tree.nearest({0, 0, 0}, 1.0f).index, -1) << "exactly at the limit";
  EXPECT_EQ(tree.nearest({0, 0, 0}, 1.0001f).index, 0);
}

TEST(PointTree, FindsTheSameFromAnyCandidate)
{
  Random random(5);
  const Points points = gridWithDuplicates(random, 500);
  const PointTree tree(points);
  for (const auto& q : gridWithDuplicates(random, 50))
    for (const float limit_sq : {0.5f, 1.0f, kInfinity})
      for (int candidate = 0; candidate < 500; candidate += 7)
        EXPECT_EQ(tree.nearest(q, limit_sq, candidate, points[candidate]).index,
                  tree.nearest(q, limit_sq).index);
}

TEST(PointTree, IsTheSameForEveryThreadCount)
{
  Random random(4);
  const Points points = gridWithDuplicates(random, 3000);
  const PointTree one(points, 1), eight(points, 8);
  for (const auto& q : pcl6d::test::randomCube(random, 300, 10))
    expectEqual(one.nearestK(q, 20), eight.nearestK(q, 20));
}
