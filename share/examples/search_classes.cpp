// SPDX-License-Identifier: BSD-3-Clause
// Shows: the search structures behind pcl::search::Search, which all exact ones answer
// alike, and what they add to PCL's interface.
#include "synthetic.h"

#include <pcl6d/search/pcl/approximate_kd_tree.h>
#include <pcl6d/search/pcl/brute_force_search.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>
#include <pcl6d/search/pcl/kd_tree.h>
#include <pcl6d/search/pcl/octree_search.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Search = pcl::search::Search<Point>;

int
main()
{
  const auto cloud = makeRoomCorner<Point>(1, Eigen::Isometry3d::Identity());
  const Point query(1, 1, 1);

  bool alike = true;
  pcl::Indices expected;
  for (const Search::Ptr& search :
       {Search::Ptr(new pcl6d::BruteForceSearch<Point>),
        Search::Ptr(new pcl6d::KdTree<Point>),
        Search::Ptr(new pcl6d::CachedKdTree<Point>),
        Search::Ptr(new pcl6d::ApproximateKdTree<Point>(0)), // 0: exact
        Search::Ptr(new pcl6d::OctreeSearch<Point>)}) {
    search->setInputCloud(cloud);
    pcl::Indices indices;
    std::vector<float> squared_distances;
    search->nearestKSearch(query, 5, indices, squared_distances);
    const int within = search->radiusSearch(query, 1.2, indices, squared_distances);
    if (expected.empty())
      expected = indices;
    alike &= indices == expected && within > 0;
    std::printf("%-24s %d points within 1.2 m, the nearest is %d\n",
                search->getName().c_str(),
                within,
                indices[0]);
  }

  pcl6d::KdTree<Point> tree;
  tree.setInputCloud(cloud);
  const pcl6d::Neighbour found = tree.nearest(query, 0.5); // within 0.5 m: none
  alike &= found.index == -1;
  std::puts(alike ? "all of them agree" : "they do NOT agree");
  return alike ? 0 : 1;
}
