// SPDX-License-Identifier: BSD-3-Clause
// FLANN through PCL finds points at the distances that the definition gives; which of several
// at the same distance is its own affair.
#include "oracle.h"
#include "support/points.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/search/flann_tree.h>
#include <pcl6d/search/point_tree.h>

#include <set>

using namespace pcl6d::test;
using pcl6d::FlannTree;
using pcl6d::Neighbour;
using pcl6d::Points;
using pcl6d::Random;
using Neighbours = std::vector<Neighbour>;

namespace {
/** Expects the distances of the definition, each of another point that is so far away. */
void
expectAsNear(const Points& points,
             const Eigen::Vector3f& query,
             const Neighbours& found,
             const Neighbours& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  std::set<int> places;
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].distance_sq, expected[i].distance_sq) << "neighbour " << i;
    ASSERT_EQ(
        pcl6d::distanceSq(query, points.at(static_cast<std::size_t>(found[i].index))),
        found[i].distance_sq);
    ASSERT_TRUE(places.insert(found[i].index).second) << found[i].index << " twice";
  }
}

void
expectAgreesWithOracle(const Points& points, const Points& queries)
{
  const FlannTree tree(points);
  for (const auto& q : queries) {
    for (const float limit_sq : {1e-6f, 0.01f, 1.0f, 25.0f, 1e38f, kInfinity}) {
      const Neighbours expected = allWithin(points, q, limit_sq);
      const Neighbour nearest = tree.nearest(q, limit_sq);
      ASSERT_EQ(nearest.index < 0, expected.empty());
      if (!expected.empty())
        expectAsNear(points, q, {nearest}, firstOf(expected, 1));
      expectAsNear(points, q, tree.withinRadius(q, limit_sq), expected);
      expectAsNear(points, q, tree.withinRadius(q, limit_sq, 7), firstOf(expected, 7));
    }
    const Neighbours all = allWithin(points, q, kInfinity);
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, points.size() + 5})
      expectAsNear(points, q, tree.nearestK(q, k), firstOf(all, k));
  }
}
} // namespace

TEST(FlannTree, AgreesOnRandomPointsAndOnFewOfThem)
{
  Random random(1);
  expectAgreesWithOracle(randomCube(random, 3000, 10), randomCube(random, 40, 14));
  for (std::size_t count = 0; count <= 20; ++count)
    expectAgreesWithOracle(randomCube(random, count, 4), randomCube(random, 10, 6));
}

TEST(FlannTree, FindsPointsAsNearAmongManyTies)
{
  Random random(2);
  const Points points = gridWithDuplicates(random, 1000);
  expectAgreesWithOracle(points, gridWithDuplicates(random, 30));
  expectAgreesWithOracle(points, randomCube(random, 30, 10));
  expectAgreesWithOracle(Points(300, {1, 2, 3}), {{0, 0, 0}, {1, 2, 3}, {1, 2, 4}});
}

TEST(FlannTree, AgreesFarFromTheOrigin)
{
  Random random(8);
  Points points = randomCube(random, 1000, 10), queries = randomCube(random, 30, 12);
  for (auto* set : {&points, &queries})
    for (auto& p : *set)
      p += Eigen::Vector3f(1e6f, -1e6f, 1e6f);
  expectAgreesWithOracle(points, queries);
}

TEST(FlannTree, LeavesOutPointsThatAreNotFinite)
{
  Random random(9);
  Points points = randomCube(random, 200, 10);
  for (std::size_t i = 0; i < points.size(); i += 3)
    points[i][static_cast<int>(i % 3)] =
        i % 2 ? kNan : (i % 4 ? kInfinity : -kInfinity);
  EXPECT_EQ(FlannTree(points).size(), 133u);
  expectAgreesWithOracle(points, randomCube(random, 30, 12));
  expectAgreesWithOracle(Points(5, {kNan, 0, 0}), {{0, 0, 0}});
  expectAgreesWithOracle({}, {{0, 0, 0}});
}

TEST(FlannTree, FindsNothingForAQueryThatIsNotFinite)
{
  const FlannTree tree(Points(30, {1, 0, 0}));
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(tree.nearest({bad, 0, 0}, kInfinity).index, -1);
    EXPECT_TRUE(tree.nearestK({0, bad, 0}, 3).empty());
    EXPECT_TRUE(tree.withinRadius({0, 0, bad}, kInfinity).empty());
  }
  EXPECT_EQ(tree.nearest({1, 0, 0}, kNan).index, -1);
  EXPECT_EQ(tree.nearest({1, 0, 0}, -1).index, -1);
}

TEST(FlannTree, LeavesOutAPointExactlyAtTheLimit)
{
  const FlannTree tree(Points{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  EXPECT_EQ(tree.nearest({0, 0, 0}, 1.0f).index, -1);
  EXPECT_EQ(tree.nearest({0, 0, 0}, std::nextafter(1.0f, 2.0f)).index, 0);
  EXPECT_EQ(tree.withinRadius({0, 0, 0}, 9.0f).size(), 2u);
  EXPECT_EQ(tree.nearest({1, 0, 0}, 0.0f).index, -1);
}

TEST(FlannTree, MayBeAskedByManyThreads)
{
  Random random(3);
  const Points points = randomCube(random, 2000, 10);
  const Points queries = randomCube(random, 4000, 10);
  const FlannTree tree(points);
  const pcl6d::PointTree ours(points);
  std::vector<int> found(queries.size(), -1);
  pcl6d::parallelFor(queries.size(), 8, [&](std::size_t i) {
    found[i] = tree.nearest(queries[i], 1).index;
  });
  for (std::size_t i = 0; i < queries.size(); ++i)
    ASSERT_EQ(found[i], ours.nearest(queries[i], 1).index) << "no two are equally near";
}
