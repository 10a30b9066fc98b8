// SPDX-License-Identifier: BSD-3-Clause
// The octree against OctoMap's own insertion of scans.
#include <pcl6d/common/random.h>
#include <pcl6d/maps/octree_map.h>

#include <gtest/gtest.h>

#include <octomap/OcTree.h>

namespace {
constexpr double kEdge = 0.25;     ///< [m]
constexpr double kLongest = 6;     ///< [m] of a ray; some are longer
constexpr std::size_t kRays = 500; ///< of a scan

/** \return a scan with points in a cube of 12 m, some of them far away */
pcl6d::MappedScan
randomRays(pcl6d::Random& random)
{
  const auto place = [&](double half) {
    return Eigen::Vector3d(random.uniform(-half, half),
                           random.uniform(-half, half),
                           random.uniform(-half, half))
        .cast<float>()
        .eval();
  };
  pcl6d::MappedScan scan;
  scan.origin = place(2);
  for (std::size_t i = 0; i < kRays; ++i)
    scan.points.push_back(place(6));
  return scan;
}

TEST(OctreeMap, IsTheTreeThatOctomapBuilds)
{
  for (const bool is_cut : {false, true}) {
    SCOPED_TRACE(is_cut);
    pcl6d::Random random(7);
    pcl6d::OctreeMapOptions options;
    options.resolution = kEdge;
    options.lowest = 0.1192; // as in the code of OctoMap, which the paper rounds
    options.highest = 0.971;
    if (is_cut)
      options.max_range = kLongest;
    pcl6d::OctreeMap map(options);
    octomap::OcTree tree(kEdge);
    for (int i = 0; i < 5; ++i) {
      const pcl6d::MappedScan scan = randomRays(random);
      ASSERT_TRUE(map.insert(scan));
      octomap::Pointcloud cloud;
      for (const auto& p : scan.points)
        cloud.push_back(p.x(), p.y(), p.z());
      const octomap::point3d origin(scan.origin.x(), scan.origin.y(), scan.origin.z());
      tree.insertPointCloud(cloud, origin, is_cut ? kLongest : -1, false, true);
    }
    std::size_t occupied = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      const auto p = leaf.getCoordinate();
      ASSERT_NEAR(map.probability({p.x(), p.y(), p.z()}), leaf->getOccupancy(), 1e-6);
      occupied += tree.isNodeOccupied(*leaf) ? 1 : 0;
    }
    EXPECT_EQ(map.numNodes(), tree.size());
    EXPECT_GT(occupied, kRays);
  }
}
} // namespace
