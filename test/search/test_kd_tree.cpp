// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/search/kd_tree.h>

#include <gtest/gtest.h>

namespace {
using Point = pcl::PointXYZI;
using Cloud = pcl::PointCloud<Point>;

Cloud::Ptr
randomCloud(std::size_t count)
{
  pcl6d::Random random(11);
  auto cloud = pcl::make_shared<Cloud>();
  for (const auto& p : pcl6d::test::randomCube(random, count, 10)) {
    Point point;
    point.getVector3fMap() = p;
    cloud->push_back(point);
  }
  return cloud;
}
} // namespace

TEST(KdTree, FindsWhatPclFinds)
{
  const auto cloud = randomCloud(2000);
  const pcl::search::Search<Point>::Ptr ours(new pcl6d::KdTree<Point>);
  pcl::search::KdTree<Point> theirs;
  ours->setInputCloud(cloud);
  theirs.setInputCloud(cloud);
  pcl::Indices a, b;
  std::vector<float> da, db;
  for (int i = 0; i < 100; ++i) {
    Point query;
    query.getVector3fMap() = 1.2f * (*cloud)[i].getVector3fMap();
    EXPECT_EQ(ours->nearestKSearch(query, 9, a, da), 9);
    theirs.nearestKSearch(query, 9, b, db);
    EXPECT_EQ(a, b);
    ours->radiusSearch(query, 1.5, a, da);
    theirs.radiusSearch(query, 1.5, b, db);
    EXPECT_EQ(a, b);
    EXPECT_EQ(ours->radiusSearch(query, 1.5, a, da, 3), std::min<int>(3, b.size()));
  }
}

TEST(KdTree, ReturnsIndicesOfTheCloudWhenGivenIndices)
{
  const auto cloud = randomCloud(100);
  auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{90, 5, 40});
  pcl6d::KdTree<Point> tree;
  tree.setInputCloud(cloud, indices);
  pcl::Indices found;
  std::vector<float> distances;
  EXPECT_EQ(tree.nearestKSearch((*cloud)[40], 10, found, distances), 3);
  EXPECT_EQ(found[0], 40);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (pcl::Indices{5, 40, 90}));
}

TEST(KdTree, RefusesANullCloud)
{
  pcl6d::KdTree<Point> tree;
  EXPECT_THROW(tree.setInputCloud(nullptr), pcl6d::BadArgument);
}

TEST(KdTree, FindsNothingBeforeItHasACloud)
{
  const pcl6d::KdTree<Point> tree;
  pcl::Indices found;
  std::vector<float> distances;
  EXPECT_EQ(tree.nearestKSearch(Point(), 1, found, distances), 0);
  ASSERT_EQ(distances.size(), 1u); // what pcl::Registration::getFitnessScore reads
  EXPECT_TRUE(std::isinf(distances[0]));
  EXPECT_EQ(tree.radiusSearch(Point(), 1.0, found, distances), 0);
}
