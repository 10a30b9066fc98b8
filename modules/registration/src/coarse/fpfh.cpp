// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/fpfh.h"

#include <pcl6d/common/parallel.h>

#include <pcl/features/fpfh.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kBlockSize = 128;
constexpr int kBins = 11;

// PCL's compiled instance: its arc tangents stay in PCL's library.
using Estimation =
    pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33>;

struct Neighbours {
  pcl::Indices indices;
  std::vector<float> distances_sq;
};

bool
hasNormal(const FeatureScan& scan, std::size_t i)
{
  return !scan.normals[i].isZero(0);
}

std::vector<Neighbours>
findNeighbours(const FeatureScan& scan, double radius, unsigned int num_threads)
{
  std::vector<Neighbours> all(scan.points.size());
  const auto radius_sq = static_cast<float>(radius * radius);
  parallelBlocks(all.size(), kBlockSize, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (!hasNormal(scan, i))
        continue;
      for (const auto& n : scan.tree.withinRadius(scan.points[i], radius_sq)) {
        if (!hasNormal(scan, static_cast<std::size_t>(n.index)))
          continue;
        all[i].indices.push_back(n.index);
        all[i].distances_sq.push_back(n.distance_sq);
      }
    }
  });
  return all;
}

/** What the points alone say: a row per point and an array per angle. */
using SimpleHistograms = std::array<Eigen::MatrixXf, 3>;

SimpleHistograms
simpleHistograms(const FeatureScan& scan,
                 const std::vector<Neighbours>& near,
                 unsigned int num_threads)
{
  const std::size_t size = scan.points.size();
  pcl::PointCloud<pcl::PointXYZ> cloud;
  pcl::PointCloud<pcl::Normal> normals;
  for (std::size_t i = 0; i < size; ++i) {
    const auto &p = scan.points[i], &n = scan.normals[i];
    cloud.emplace_back(p.x(), p.y(), p.z());
    normals.emplace_back(n.x(), n.y(), n.z());
  }
  SimpleHistograms simple;
  for (auto& histogram : simple)
    histogram.setZero(static_cast<Eigen::Index>(size), kBins);
  parallelBlocks(size, kBlockSize, num_threads, [&](const Block& block) {
    Estimation estimation;
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (near[i].indices.size() > 1)
        estimation.computePointSPFHSignature(cloud,
                                             normals,
                                             static_cast<pcl::index_t>(i),
                                             static_cast<int>(i),
                                             near[i].indices,
                                             simple[0],
                                             simple[1],
                                             simple[2]);
  });
  return simple;
}
} // namespace

std::vector<Fpfh>
computeFpfh(const FeatureScan& scan, double radius, unsigned int num_threads)
{
  const auto near = findNeighbours(scan, radius, num_threads);
  const SimpleHistograms simple = simpleHistograms(scan, near, num_threads);
  std::vector<Fpfh> features(scan.points.size(), Fpfh{});
  parallelBlocks(features.size(), kBlockSize, num_threads, [&](const Block& block) {
    Estimation estimation;
    Eigen::VectorXf feature;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      estimation.weightPointSPFHSignature(simple[0],
                                          simple[1],
                                          simple[2],
                                          near[i].indices,
                                          near[i].distances_sq,
                                          feature);
      std::copy_n(feature.data(), kFpfhSize, features[i].begin());
    }
  });
  return features;
}

} // namespace pcl6d::registration
