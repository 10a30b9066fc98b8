// SPDX-License-Identifier: BSD-3-Clause
// Clouds far from the origin: the place that coordinates are counted from.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/search/pcl/approximate_kd_tree.h>
#include <pcl6d/search/pcl/brute_force_search.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>
#include <pcl6d/search/pcl/kd_tree.h>
#include <pcl6d/search/pcl/octree_search.h>

#include <cmath>
#include <cstring>

using namespace pcl6d::test;
using pcl6d::localOrigin;
using pcl6d::Points;
using pcl6d::Random;

namespace {
using Point = pcl::PointXYZ;
using Search = pcl::search::Search<Point>;
const Eigen::Vector3f kZero = Eigen::Vector3f::Zero();
const Eigen::Vector3f kUtm(6.9e5f, 5.3e6f, 100); // [m]

/** \return points of a grid of half a metre, which float holds exactly at kUtm */
Points
gridPoints(Random& random, std::size_t count, double extent)
{
  Points points = randomCube(random, count, extent);
  for (auto& p : points)
    p = (2 * p).array().round().matrix() / 2;
  return points;
}

Points
shifted(Points points, const Eigen::Vector3f& by)
{
  for (auto& p : points)
    p += by;
  return points;
}

std::vector<Search::Ptr>
allSearches()
{
  return {pcl::make_shared<pcl6d::KdTree<Point>>(),
          pcl::make_shared<pcl6d::CachedKdTree<Point>>(),
          pcl::make_shared<pcl6d::ApproximateKdTree<Point>>(0),
          pcl::make_shared<pcl6d::OctreeSearch<Point>>(),
          pcl::make_shared<pcl6d::BruteForceSearch<Point>>()};
}

Point
toPoint(const Eigen::Vector3f& p)
{
  return {p.x(), p.y(), p.z()};
}

struct Found {
  pcl::Indices indices;
  std::vector<float> distances_sq;

  bool
  operator==(const Found& other) const
  {
    return indices == other.indices && distances_sq == other.distances_sq;
  }
};
} // namespace

TEST(LocalOrigin, IsZeroNearTheOrigin)
{
  Random random(1);
  EXPECT_EQ(localOrigin({}), kZero);
  for (const float away : {0.0f, 100.0f, 8000.0f})
    EXPECT_EQ(localOrigin(shifted(randomCube(random, 100, 10), {away, 0, -away})),
              kZero)
        << away;
  EXPECT_EQ(localOrigin({{8192, 0, 0}}), kZero);
  EXPECT_NE(localOrigin({{8193, 0, 0}}), kZero);
}

TEST(LocalOrigin, IsZeroForWideClouds)
{
  // No one place is near all points.
  EXPECT_EQ(localOrigin({{0, 0, 0}, {1e6f, 0, 0}}), kZero);
  EXPECT_EQ(localOrigin({{1e6f, 0, 0}, {1e6f + 8193, 0, 0}}), kZero);
}

TEST(LocalOrigin, IsNotMovedByAFewWildPoints)
{
  Random random(5);
  Points points = shifted(gridPoints(random, 500, 60), kUtm);
  const Eigen::Vector3f origin = localOrigin(points);
  for (const Eigen::Vector3f& wild : {kZero, Eigen::Vector3f(1e7f, 1e7f, 1e7f)})
    points.insert(points.begin() + 7, wild);
  EXPECT_EQ(localOrigin(points), origin);
  EXPECT_NE(origin, kZero);
}

TEST(LocalOrigin, LeavesOutPointsThatAreNotFinite)
{
  EXPECT_EQ(localOrigin({{kNan, 0, 0}, {0, kInfinity, 0}}), kZero);
  EXPECT_EQ(localOrigin({kUtm, {kNan, 0, 0}, {0, -kInfinity, 0}}), localOrigin({kUtm}));
}

TEST(LocalOrigin, IsNearTheCloudInWholeKilobinaryMetres)
{
  Random random(2);
  const Eigen::Vector3f origin =
      localOrigin(shifted(gridPoints(random, 500, 60), kUtm));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(std::fmod(origin[axis], 1024.0f), 0) << axis;
    EXPECT_LE(std::abs(origin[axis] - kUtm[axis]), 512 + 30) << axis;
  }
  EXPECT_EQ(origin.z(), 0);
}

/** Coordinates below 2^24 m, of either sign: what float minus float gives is what double
 * minus double gives. */
TEST(LocalOrigin, IsSubtractedWithoutRounding)
{
  Random random(3);
  for (const Eigen::Vector3f& place : {kUtm,
                                       Eigen::Vector3f(-4.2e6f, 1.2e4f, -9e3f),
                                       Eigen::Vector3f(1.5e7f, 0, 8.7e3f)})
    for (const double extent : {1.0, 60.0, 4000.0}) {
      const Points points = shifted(randomCube(random, 500, extent), place);
      const Eigen::Vector3f origin = localOrigin(points);
      ASSERT_NE(origin, kZero);
      for (const auto& p : points) {
        const Eigen::Vector3f local = p - origin;
        const Eigen::Vector3d exact = p.cast<double>() - origin.cast<double>();
        ASSERT_EQ(local.cast<double>(), exact) << p.transpose();
      }
    }
}

TEST(FarSearches, FindTheSameAsNearTheOrigin)
{
  Random random(4);
  const Points points = gridPoints(random, 2000, 30),
               queries = gridPoints(random, 60, 34);
  const auto near_cloud = toCloud<Point>(points);
  const auto far_cloud = toCloud<Point>(shifted(points, kUtm));
  for (const auto& search : allSearches()) {
    SCOPED_TRACE(search->getName());
    const auto ask = [&](const pcl::PointCloud<Point>::Ptr& cloud,
                         const Eigen::Vector3f& place) {
      search->setInputCloud(cloud);
      std::vector<Found> all;
      for (const auto& q : shifted(queries, place)) {
        for (const int k : {1, 2, 15, 3000}) {
          Found& found = all.emplace_back();
          search->nearestKSearch(toPoint(q), k, found.indices, found.distances_sq);
        }
        for (const double radius : {0.5, 3.1, 40.0}) {
          Found& found = all.emplace_back();
          search->radiusSearch(toPoint(q), radius, found.indices, found.distances_sq);
        }
      }
      return all;
    };
    EXPECT_TRUE(ask(far_cloud, kUtm) == ask(near_cloud, kZero));
  }
}

TEST(FarSearches, ReturnTheSameIndexWhateverTheStructure)
{
  // Not on a grid: float rounds the coordinates there to half a metre, hence many ties.
  Random random(5);
  const auto cloud = toCloud<Point>(shifted(randomCube(random, 3000, 40), kUtm));
  const Points queries = shifted(randomCube(random, 200, 44), kUtm);
  const auto searches = allSearches();
  for (const auto& search : searches)
    search->setInputCloud(cloud);
  for (const auto& q : queries) {
    int expected = 0; // by double
    for (int i = 1; i < static_cast<int>(cloud->size()); ++i)
      if (((*cloud)[i].getVector3fMap() - q).cast<double>().squaredNorm() <
          ((*cloud)[expected].getVector3fMap() - q).cast<double>().squaredNorm())
        expected = i;
    for (const auto& search : searches) {
      Found found;
      ASSERT_EQ(
          search->nearestKSearch(toPoint(q), 1, found.indices, found.distances_sq), 1);
      ASSERT_EQ(found.indices[0], expected) << search->getName();
    }
  }
}

TEST(FarSearches, KnowTheirOriginAndForgetItWithTheNextCloud)
{
  pcl6d::KdTree<Point> tree;
  EXPECT_EQ(tree.origin(), kZero);
  tree.setInputCloud(toCloud<Point>({kUtm}));
  EXPECT_EQ(tree.origin(), localOrigin({kUtm}));
  EXPECT_EQ(tree.nearest(toPoint(kUtm), 0.1).index, 0);
  EXPECT_EQ(tree.nearest(toPoint(kUtm), 0.1).distance_sq, 0);
  EXPECT_EQ(tree.nearest(toPoint(kZero), 1e3).index, -1);
  tree.setInputCloud(toCloud<Point>({{1, 2, 3}}));
  EXPECT_EQ(tree.origin(), kZero);
  EXPECT_EQ(tree.nearest({1, 2, 3}, 0.1).index, 0);
}

TEST(FarSearches, CountFromTheChosenPoints)
{
  // The others may lie anywhere.
  const auto cloud = toCloud<Point>({{0, 0, 0}, kUtm, kUtm + Eigen::Vector3f(1, 0, 0)});
  pcl6d::KdTree<Point> tree;
  tree.setInputCloud(cloud);
  EXPECT_EQ(tree.origin(), kZero) << "too wide";
  tree.setInputCloud(cloud, pcl::make_shared<pcl::Indices>(pcl::Indices{1, 2}));
  EXPECT_NE(tree.origin(), kZero);
  EXPECT_EQ(tree.nearest((*cloud)[2], 0.5).index, 2);
}

TEST(FarSearches, CachedOnesStartFromTheirSlotsThereToo)
{
  Random random(6);
  const auto cloud = toCloud<Point>(shifted(gridPoints(random, 2000, 30), kUtm));
  pcl6d::CachedKdTree<Point> cached;
  pcl6d::BruteForceSearch<Point> oracle;
  cached.setInputCloud(cloud);
  oracle.setInputCloud(cloud);
  const Points queries = shifted(gridPoints(random, 50, 34), kUtm);
  cached.setNumSlots(queries.size());
  for (int again = 0; again < 3; ++again)
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Point q = toPoint(queries[i] + Eigen::Vector3f(0.5f * again, 0, 0));
      EXPECT_EQ(cached.nearestCached(i, q, 4).index, oracle.nearest(q, 4).index);
    }
}
