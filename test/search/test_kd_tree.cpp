// SPDX-License-Identifier: BSD-3-Clause
// The structures behind PCL's interface.
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/search/pcl/approximate_kd_tree.h>
#include <pcl6d/search/pcl/brute_force_search.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>
#include <pcl6d/search/pcl/kd_tree.h>
#include <pcl6d/search/pcl/octree_search.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <type_traits>

namespace {
using Point = pcl::PointXYZI;
using Cloud = pcl::PointCloud<Point>;
using Search = pcl::search::Search<Point>;
using pcl6d::test::badArgumentOf;

template <typename Class>
constexpr bool kFitsRegistration = std::is_base_of_v<pcl::search::KdTree<Point>, Class>;
static_assert(kFitsRegistration<pcl6d::KdTree<Point>>);
static_assert(kFitsRegistration<pcl6d::CachedKdTree<Point>>);
static_assert(kFitsRegistration<pcl6d::ApproximateKdTree<Point>>);

Cloud::Ptr
randomCloud(std::size_t count)
{
  pcl6d::Random random(11);
  return pcl6d::test::toCloud<Point>(pcl6d::test::randomCube(random, count, 10));
}

struct SearchClass {
  std::string name;
  std::function<Search::Ptr()> make;
};

void
PrintTo(const SearchClass& search, std::ostream* out)
{
  *out << search.name;
}

class PclSearch : public testing::TestWithParam<SearchClass> {};
} // namespace

TEST_P(PclSearch, FindsWhatPclFinds)
{
  const auto cloud = randomCloud(2000);
  const Search::Ptr ours = GetParam().make();
  pcl::search::KdTree<Point> theirs;
  ours->setInputCloud(cloud);
  theirs.setInputCloud(cloud);
  pcl::Indices a, b;
  std::vector<float> da, db;
  for (int i = 0; i < 100; ++i) {
    Point query;
    query.getVector3fMap() = 1.2f * (*cloud)[i].getVector3fMap();
    for (const int k : {1, 9}) {
      EXPECT_EQ(ours->nearestKSearch(query, k, a, da), k);
      theirs.nearestKSearch(query, k, b, db);
      EXPECT_EQ(a, b);
    }
    EXPECT_EQ(ours->nearestKSearch(*cloud, i, 1, a, da), 1);
    EXPECT_EQ(a, pcl::Indices{i});
    EXPECT_EQ(ours->nearestKSearch(i, 1, a, da), 1);
    EXPECT_EQ(a, pcl::Indices{i});
    ours->radiusSearch(query, 1.5, a, da);
    theirs.radiusSearch(query, 1.5, b, db);
    EXPECT_EQ(a, b);
    EXPECT_EQ(ours->radiusSearch(query, 1.5, a, da, 3), std::min<int>(3, b.size()));
  }
}

TEST_P(PclSearch, ReturnsIndicesOfTheCloudWhenGivenIndices)
{
  const auto cloud = randomCloud(100);
  const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{90, 5, 40});
  const Search::Ptr search = GetParam().make();
  search->setInputCloud(cloud, indices);
  EXPECT_EQ(search->getIndices(), indices);
  EXPECT_EQ(search->getInputCloud(), cloud);
  pcl::Indices found;
  std::vector<float> distances;
  EXPECT_EQ(search->nearestKSearch((*cloud)[40], 1, found, distances), 1);
  EXPECT_EQ(found, pcl::Indices{40});
  EXPECT_EQ(search->nearestKSearch((*cloud)[40], 10, found, distances), 3);
  EXPECT_EQ(found[0], 40);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (pcl::Indices{5, 40, 90}));
}

TEST_P(PclSearch, RefusesANullCloudAndKeepsTheOld)
{
  const Search::Ptr search = GetParam().make();
  const auto cloud = randomCloud(10);
  search->setInputCloud(cloud);
  EXPECT_EQ(badArgumentOf([&] { search->setInputCloud(nullptr); }),
            search->getName() + ": the input cloud is null");
  pcl::Indices found;
  std::vector<float> distances;
  EXPECT_EQ(search->getInputCloud(), cloud);
  EXPECT_EQ(search->nearestKSearch((*cloud)[3], 1, found, distances), 1);
  EXPECT_EQ(found, pcl::Indices{3});
}

TEST_P(PclSearch, RefusesIndicesOfNoPoint)
{
  const Search::Ptr search = GetParam().make();
  for (const int bad : {-1, 10, 999999999})
    EXPECT_NE(badArgumentOf([&] {
                search->setInputCloud(
                    randomCloud(10),
                    pcl::make_shared<pcl::Indices>(pcl::Indices{0, bad}));
              }).find("index = " + std::to_string(bad)),
              std::string::npos);
}

TEST_P(PclSearch, FindsNothingWithinANegativeRadius)
{
  const Search::Ptr search = GetParam().make();
  const auto cloud = randomCloud(10);
  search->setInputCloud(cloud);
  pcl::Indices found;
  std::vector<float> distances;
  for (const double radius : {-1.0, 0.0, std::nan("")})
    EXPECT_EQ(search->radiusSearch((*cloud)[3], radius, found, distances), 0);
}

TEST_P(PclSearch, FindsNothingBeforeItHasACloudOrInAnEmptyOne)
{
  const Search::Ptr search = GetParam().make();
  pcl::Indices found;
  std::vector<float> distances;
  for (int round = 0; round < 2; ++round) {
    for (const int k : {1, 5}) {
      EXPECT_EQ(search->nearestKSearch(Point(), k, found, distances), 0);
      EXPECT_EQ(found, pcl::Indices{-1});
      ASSERT_EQ(distances.size(), 1u); // what pcl::Registration::getFitnessScore reads
      EXPECT_TRUE(std::isinf(distances[0]));
    }
    EXPECT_EQ(search->nearestKSearch(Point(), 0, found, distances), 0);
    EXPECT_TRUE(found.empty());
    EXPECT_EQ(search->radiusSearch(Point(), 1.0, found, distances), 0);
    EXPECT_TRUE(found.empty());
    search->setInputCloud(randomCloud(0));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Search,
    PclSearch,
    testing::Values(
        SearchClass{"KdTree", [] { return Search::Ptr(new pcl6d::KdTree<Point>); }},
        SearchClass{"CachedKdTree",
                    [] {
                      auto tree = new pcl6d::CachedKdTree<Point>;
                      tree->setNumSlots(50); // fewer than the queries
                      return Search::Ptr(tree);
                    }},
        SearchClass{"ApproximateKdTree",
                    [] { return Search::Ptr(new pcl6d::ApproximateKdTree<Point>(0)); }},
        SearchClass{"OctreeSearch",
                    [] { return Search::Ptr(new pcl6d::OctreeSearch<Point>); }},
        SearchClass{"BruteForceSearch",
                    [] { return Search::Ptr(new pcl6d::BruteForceSearch<Point>); }}),
    [](const auto& tested) { return tested.param.name; });

TEST(KdTree, HasNoTreeBeforeItHasACloud)
{
  pcl6d::KdTree<Point> tree;
  EXPECT_EQ(tree.tree(), nullptr);
  tree.setInputCloud(randomCloud(10));
  EXPECT_EQ(tree.tree()->size(), 10u);
}

TEST(KdTree, FindsTheNearestWithinALimit)
{
  pcl6d::KdTree<Point> tree;
  tree.setInputCloud(pcl6d::test::toCloud<Point>({{9, 9, 9}, {3, 0, 0}, {1, 0, 0}}),
                     pcl::make_shared<pcl::Indices>(pcl::Indices{0, 2}));
  EXPECT_EQ(tree.nearest(Point(), 1.0).index, -1);
  EXPECT_EQ(tree.nearest(Point(), 1.5).index, 2);
  EXPECT_EQ(tree.nearest(Point(), 1e200).distance_sq, 1.0f);
}

TEST(CachedKdTree, FindsTheSameInEverySlotWhileTheQueriesMove)
{
  const auto cloud = randomCloud(3000), moved = randomCloud(100);
  pcl6d::CachedKdTree<Point> tree;
  tree.setInputCloud(cloud);
  tree.setNumSlots(moved->size());
  pcl::Indices found, expected;
  std::vector<float> distances;
  for (int iteration = 0; iteration < 10; ++iteration)
    for (std::size_t i = 0; i < moved->size(); ++i) {
      Point& query = (*moved)[i];
      query.x += 0.05f;
      EXPECT_EQ(tree.nearestCached(i, query, 0.4).index,
                tree.nearest(query, 0.4).index);
      tree.nearestKSearch(*moved, static_cast<int>(i), 1, found, distances);
      tree.nearestKSearch(query, 1, expected, distances);
      EXPECT_EQ(found, expected);
    }
}

TEST(CachedKdTree, EmptiesTheSlotsForANewCloudAndKnowsTheirNumber)
{
  pcl6d::CachedKdTree<Point> tree;
  tree.setNumSlots(1);
  tree.setInputCloud(randomCloud(3000));
  EXPECT_GE(tree.nearestCached(0, Point(), 100).index, 0);
  tree.setInputCloud(randomCloud(5)); // has no such leaf
  EXPECT_GE(tree.nearestCached(0, Point(), 100).index, 0);
  EXPECT_EQ(badArgumentOf([&] { tree.nearestCached(1, Point(), 1); }),
            "CachedKdTree: slot 1 of 1");
}

TEST(ApproximateKdTree, TakesItsEpsilonByPclsSetter)
{
  const auto cloud = randomCloud(3000), queries = randomCloud(3200);
  pcl6d::ApproximateKdTree<Point> tree(0);
  pcl6d::KdTree<Point> exact;
  tree.setInputCloud(cloud);
  exact.setInputCloud(cloud);
  pcl::search::KdTree<Point>& base = tree;
  for (const float epsilon : {0.0f, 2.0f}) {
    base.setEpsilon(epsilon);
    int inexact = 0;
    for (std::size_t i = 3000; i < queries->size(); ++i)
      inexact += tree.nearest((*queries)[i], 100).index !=
                 exact.nearest((*queries)[i], 100).index;
    EXPECT_EQ(inexact > 0, epsilon > 0);
  }
  EXPECT_THROW(tree.setEpsilon(-1), pcl6d::BadArgument);
  EXPECT_EQ(tree.getEpsilon(), 2.0f);
}
