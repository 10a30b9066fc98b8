// SPDX-License-Identifier: BSD-3-Clause
// The cached k-d tree for callers that do not number their queries.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/search/leaf_memory.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>

#include <gtest/gtest.h>

#include <array>

using pcl6d::LeafMemory;
using pcl6d::Random;
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

namespace {
Cloud::Ptr
cube(std::uint64_t seed, std::size_t count)
{
  Random random(seed);
  return pcl6d::test::toCloud<Point>(pcl6d::test::randomCube(random, count, 1));
}

int
nearestOf(const pcl::search::KdTree<Point>& tree, const Point& query)
{
  pcl::Indices found;
  std::vector<float> distances;
  tree.nearestKSearch(query, 1, found, distances);
  return found[0];
}
} // namespace

TEST(LeafMemory, KnowsEachPointOfAnArray)
{
  std::array<Point, 100> points;
  LeafMemory memory(points.size());
  EXPECT_EQ(memory.leafOf(&points[3], sizeof(Point)), -1);
  for (std::size_t i = 0; i < points.size(); ++i)
    memory.remember(&points[i], sizeof(Point), static_cast<int>(7 * i));
  EXPECT_EQ(memory.count(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(memory.leafOf(&points[i], sizeof(Point)), static_cast<int>(7 * i));
  memory.remember(&points[3], sizeof(Point), -1);
  EXPECT_EQ(memory.leafOf(&points[3], sizeof(Point)), -1);
  EXPECT_EQ(memory.count(), points.size() - 1);
}

TEST(LeafMemory, TellsPointsApartThatShareAPlace)
{
  std::array<Point, 2> points;
  LeafMemory memory(1);
  memory.remember(&points[0], sizeof(Point), 5);
  EXPECT_EQ(memory.leafOf(&points[1], sizeof(Point)), -1);
  memory.remember(&points[1], sizeof(Point), 6);
  EXPECT_EQ(memory.leafOf(&points[0], sizeof(Point)), -1) << "forgotten, not mistaken";
  EXPECT_EQ(memory.leafOf(&points[1], sizeof(Point)), 6);
}

TEST(CachedKdTree, RemembersPointsThatMoveWhereTheyLie)
{
  const auto cloud = cube(1, 3000), moved = cube(2, 500);
  pcl6d::CachedKdTree<Point> tree;
  pcl6d::KdTree<Point> plain;
  tree.setInputCloud(cloud);
  plain.setInputCloud(cloud);
  EXPECT_EQ(tree.numRemembered(), 0u);
  for (int iteration = 0; iteration < 10; ++iteration)
    for (Point& query : *moved) {
      query.x += 0.05f;
      EXPECT_EQ(nearestOf(tree, query), nearestOf(plain, query));
    }
  EXPECT_EQ(tree.numRemembered(), moved->size());
  tree.setInputCloud(cube(3, 20)); // has no such leaves
  EXPECT_EQ(tree.numRemembered(), 0u);
  for (const Point& query : *moved)
    EXPECT_GE(nearestOf(tree, query), 0);
}

TEST(CachedKdTree, IsExactWhenOtherPointsComeToTheSameAddress)
{
  const auto cloud = cube(4, 3000), queries = cube(5, 500);
  pcl6d::CachedKdTree<Point> tree;
  pcl6d::KdTree<Point> plain;
  tree.setInputCloud(cloud);
  plain.setInputCloud(cloud);
  Point here;
  for (const Point& query : *queries) {
    here = query;
    EXPECT_EQ(nearestOf(tree, here), nearestOf(plain, query));
  }
  EXPECT_EQ(tree.numRemembered(), 1u);
}

TEST(CachedKdTree, SharesWhatItRemembersWithCopiesUntilTheirCloudsDiffer)
{
  const auto cloud = cube(6, 3000);
  pcl6d::CachedKdTree<Point> tree;
  tree.setInputCloud(cloud);
  pcl6d::CachedKdTree<Point> copy = tree;
  EXPECT_EQ(nearestOf(copy, (*cloud)[9]), 9);
  EXPECT_EQ(tree.numRemembered(), 1u);
  copy.setInputCloud(cube(7, 5));
  EXPECT_EQ(copy.numRemembered(), 0u);
  EXPECT_EQ(nearestOf(tree, (*cloud)[9]), 9);
}
