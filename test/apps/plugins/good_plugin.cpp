// SPDX-License-Identifier: BSD-3-Clause
// A plug-in with a part of each kind. Each does what a part of the suite does, by other means.
#include <pcl6d/slam6d/plugin.h>

#include <pcl/common/io.h>
#include <pcl/conversions.h>
#include <pcl/filters/passthrough.h>
#include <pcl/point_types.h>

#include <Eigen/SVD>

#include <fstream>
#include <limits>
#include <stdexcept>

namespace {
using pcl6d::Neighbour;
using pcl6d::Points;

/** The minimiser "svd", whose pairs are of rank 3 here. */
pcl6d::RigidEstimate
minimise(const pcl6d::PairSums& sums)
{
  return sums.count < 3 ? pcl6d::RigidEstimate() : pcl6d::minimiseBySVD(sums);
}

/** The search "brute-force". */
pcl6d::NearestSearch
makeSearch(const Points& points)
{
  return [points](const Eigen::Vector3f& query, float limit_sq) {
    Neighbour nearest{-1, limit_sq};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float distance_sq = pcl6d::distanceSq(query, points[i]);
      if (distance_sq < nearest.distance_sq)
        nearest = {static_cast<int>(i), distance_sq};
    }
    return nearest;
  };
}

/** Keeps what is lower than half a metre above the scanner, by a filter of PCL. */
pcl::PCLPointCloud2
keepLowPoints(const pcl::PCLPointCloud2& cloud)
{
  pcl::PassThrough<pcl::PCLPointCloud2> pass;
  pass.setInputCloud(pcl::make_shared<pcl::PCLPointCloud2>(cloud));
  pass.setFilterFieldName("z");
  pass.setFilterLimits(-1e6, 0.5);
  pcl::PCLPointCloud2 low;
  pass.filter(low);
  return low;
}

/** Rows "x y z" behind a first line "triples". */
pcl::PCLPointCloud2
readTriples(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  std::string title;
  if (!std::getline(stream, title) || title != "triples")
    throw std::runtime_error("line 1: expected 'triples', got '" + title + "'");
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (pcl::PointXYZ p; stream >> p.x >> p.y >> p.z;)
    cloud.push_back(p);
  cloud.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0}); // is dropped
  pcl::PCLPointCloud2 read;
  pcl::toPCLPointCloud2(cloud, read);
  return read;
}

void
addParts(pcl6d::PluginRegistry& registry)
{
  registry.addMinimiser("test-svd", minimise);
  registry.addPlaneMinimiser("test-linear", pcl6d::planeStepByLinear);
  registry.addSearch("test-brute", makeSearch);
  registry.addFilter("test-low", keepLowPoints);
  registry.addReader("test-triples", ".triples", readTriples);
}
} // namespace

PCL6D_PLUGIN("parts for the tests", addParts)
