// SPDX-License-Identifier: BSD-3-Clause
#include "oracle.h"
#include "plain_point_tree.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/search/point_octree.h>
#include <pcl6d/search/point_tree.h>

using namespace pcl6d::test;
using pcl6d::Neighbour;
using pcl6d::Points;
using pcl6d::PointTree;
using pcl6d::Random;

TEST(PointTree, FindsEachOfItsOwnPoints)
{
  Random random(3);
  const Points points = randomCube(random, 5000, 10);
  const PointTree tree(points);
  EXPECT_EQ(tree.size(), 5000u);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(tree.nearest(points[i], 1e-9f).index, static_cast<int>(i));
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

TEST(PointTree, HasANeighbourWhereItFindsANearest)
{
  Random random(6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Points& points :
       {randomCube(random, 3000, 20), gridWithDuplicates(random, 500), Points{}}) {
    const PointTree tree(points);
    Points queries = randomCube(random, 300, 24);
    const Points on_points = gridWithDuplicates(random, 50); // ties with the limit
    queries.insert(queries.end(), on_points.begin(), on_points.end());
    queries.insert(queries.end(), {{nan, 0, 0}, {0, kInfinity, 0}, {1e30f, 0, 0}});
    for (const auto& q : queries)
      for (const float limit_sq : {-1.0f, 0.0f, 0.25f, 1.0f, 2.0f, kInfinity, nan})
        EXPECT_EQ(tree.hasNeighbour(q, limit_sq), tree.nearest(q, limit_sq).index >= 0);
  }
}

/** Large enough that the build is shared. An approximate search shows the tree itself. */
TEST(PointTree, IsTheSameForEveryThreadCount)
{
  Random random(4);
  for (const Points& points :
       {randomCube(random, 40000, 10), gridWithDuplicates(random, 20000)}) {
    const PointTree one(points, 1);
    const pcl6d::PointOctree octree_one(points, 1);
    for (const unsigned int threads : {2u, 3u, 8u}) {
      const PointTree tree(points, threads);
      const pcl6d::PointOctree octree(points, threads);
      for (const auto& q : randomCube(random, 200, 10)) {
        EXPECT_EQ(tree.nearestApproximate(q, kInfinity, kInfinity).index,
                  one.nearestApproximate(q, kInfinity, kInfinity).index);
        expectEqual(tree.nearestK(q, 20), one.nearestK(q, 20));
        expectEqual(octree.nearestK(q, 20), octree_one.nearestK(q, 20));
      }
    }
  }
}

TEST(PointTree, GivesTheSameBitsWithoutTheVectorClone)
{
  Random random(12);
  for (const Points& points :
       {randomCube(random, 30000, 20), gridWithDuplicates(random, 3000)}) {
    const Points queries = randomCube(random, 500, 24);
    expectEqual(searchAll<PointTree, pcl6d::TwoNearest>(points, queries),
                plainSearchAll(points, queries));
  }
}

/** The cached search, from where the query was before, over growing displacements. */
TEST(CachedSearch, FindsTheSameAsTheSearchFromTheRoot)
{
  Random random(10);
  for (const Points& points :
       {randomCube(random, 3000, 20), gridWithDuplicates(random, 2000)}) {
    const PointTree tree(points, 1, PointTree::Cells::kKeep);
    for (const float limit_sq : {0.3f, 1.0f, kInfinity})
      for (const double step : {0.01, 0.1, 0.5, 1.0, 5.0})
        for (Eigen::Vector3f q : randomCube(random, 100, 22)) {
          int leaf = -1;
          for (int i = 0; i < 4; ++i) {
            const Neighbour found = tree.nearestFrom(leaf, q, limit_sq);
            const Neighbour expected = tree.nearest(q, limit_sq);
            ASSERT_EQ(found.index, expected.index);
            ASSERT_EQ(found.distance_sq, expected.distance_sq);
            q += randomCube(random, 1, 2 * step)[0];
          }
        }
  }
}

/** Queries on the cuts, starts in every leaf: the points that equal a cut lie on both
 * sides. */
TEST(CachedSearch, FindsTheSmallestIndexFromEveryLeaf)
{
  Random random(11);
  const Points points = gridWithDuplicates(random, 400);
  const PointTree tree(points, 1, PointTree::Cells::kKeep);
  for (const auto& q : gridWithDuplicates(random, 60))
    for (int start = 0; start < 50; ++start)
      for (const float limit_sq : {1.0f, kInfinity}) {
        int leaf = start;
        EXPECT_EQ(tree.nearestFrom(leaf, q, limit_sq).index,
                  tree.nearest(q, limit_sq).index);
      }
}

/** Also from the last leaves, where a node is not full. */
TEST(CachedSearch, FindsEachPointFromEveryLeafOfTreesOfAnySize)
{
  Random random(17);
  for (std::size_t size = 9; size < 200; size += 5) {
    const Points points = randomCube(random, size, 10);
    const PointTree tree(points, 1, PointTree::Cells::kKeep);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t start = 0; start < (size + 7) / 8; ++start) {
        int leaf = static_cast<int>(start); // small limit: it is easy to stop too early
        EXPECT_EQ(tree.nearestFrom(leaf, points[i], 0.01f).index, static_cast<int>(i));
      }
  }
}

TEST(CachedSearch, KeepsTheLeafWhenNothingIsFound)
{
  Random random(13);
  const PointTree tree(randomCube(random, 100, 10), 1, PointTree::Cells::kKeep);
  int leaf = 5;
  EXPECT_EQ(tree.nearestFrom(leaf, {90, 0, 0}, 1).index, -1);
  EXPECT_EQ(leaf, 5);
  EXPECT_EQ(tree.nearestFrom(leaf, {kNan, 0, 0}, 1).index, -1);
  EXPECT_EQ(leaf, 5);
}

TEST(CachedSearch, RefusesATreeWithoutCellsAndALeafThatIsNone)
{
  const Points points(3, {1, 2, 3});
  int leaf = 1;
  EXPECT_EQ(badArgumentOf([&] {
              PointTree(points).nearestFrom(leaf, {0, 0, 0}, 1);
            }),
            "PointTree: cached search in a tree without cells");
  const PointTree tree(points, 1, PointTree::Cells::kKeep);
  EXPECT_EQ(badArgumentOf([&] {
              tree.nearestFrom(leaf, {0, 0, 0}, 1);
            }),
            "PointTree: leaf 1 of 1");
}

TEST(ApproximateSearch, KeepsItsBoundAndMissesNothingWithinTheLimit)
{
  constexpr float kRounding = 1e-5f; // of the squares and the factor, relative
  Random random(14);
  const Points points = randomCube(random, 3000, 20);
  const PointTree tree(points);
  int inexact = 0;
  for (const float epsilon : {0.1f, 1.0f, 3.0f, kInfinity}) {
    const float factor = (1 + epsilon) * (1 + epsilon) * (1 + kRounding);
    for (const auto& q : randomCube(random, 300, 24)) {
      for (const float limit_sq : {0.3f, 2.0f, kInfinity}) {
        const Neighbour best = tree.nearest(q, limit_sq);
        const Neighbour found = tree.nearestApproximate(q, limit_sq, epsilon);
        ASSERT_EQ(found.index < 0, best.index < 0);
        if (best.index >= 0) {
          EXPECT_LE(found.distance_sq, factor * best.distance_sq);
        }
        inexact += found.index != best.index;
      }
      const auto exact = tree.nearestK(q, 10), some = tree.nearestK(q, 10, epsilon);
      ASSERT_EQ(some.size(), 10u);
      for (int i = 0; i < 10; ++i)
        EXPECT_LE(some[i].distance_sq, factor * exact[i].distance_sq);
    }
  }
  EXPECT_GT(inexact, 0) << "the search is not approximate at all";
}

TEST(ApproximateSearch, RefusesANegativeEpsilon)
{
  const PointTree tree(Points(3, {1, 2, 3}));
  EXPECT_THROW(tree.nearestApproximate({0, 0, 0}, 1, -0.5), pcl6d::BadArgument);
  EXPECT_THROW(tree.nearestK({0, 0, 0}, 1, std::nan("")), pcl6d::BadArgument);
}
