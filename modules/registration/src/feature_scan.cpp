// SPDX-License-Identifier: BSD-3-Clause
#include "feature_scan.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
constexpr std::size_t kBlockSize = 256;
constexpr std::size_t kMinNeighbours = 5;

Points
withoutRepeats(Points points)
{
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/** \return the direction of least spread, towards the origin; zero without a plane */
Eigen::Vector3f
normalOf(const Points& points, const std::vector<Neighbour>& near)
{
  if (near.size() < kMinNeighbours)
    return Eigen::Vector3f::Zero();
  const Eigen::Vector3d origin = points[near.front().index].cast<double>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const auto& n : near) {
    const Eigen::Vector3d d = points[n.index].cast<double>() - origin;
    sum += d;
    squares += d * d.transpose();
  }
  squares -= sum * sum.transpose() / static_cast<double>(near.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
  if (!(solver.eigenvalues()(1) > 1e-4 * solver.eigenvalues()(2))) // a line, or a point
    return Eigen::Vector3f::Zero();
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return (normal.dot(origin) > 0 ? Eigen::Vector3d(-normal) : normal).cast<float>();
}
} // namespace

Points
measuredPoints(const Points& scan)
{
  const double nothing =
      noReturnRange(scan).value_or(std::numeric_limits<double>::infinity());
  const double median = medianRange(gateByRange(scan, 0, 0.999 * nothing));
  // A sensible voxel is not below median / 60; 2^20 of these reach 17000 medians.
  return gateByRange(
      scan, std::min(0.2, 0.1 * median), std::min(0.999 * nothing, 1e4 * median));
}

double
distinctSpacing(const Points& points)
{
  return medianSpacing(withoutRepeats(points));
}

double
featureVoxel(const Points& measured, std::size_t max_points)
{
  const double range = medianRange(measured);
  double voxel = std::max(2.5 * distinctSpacing(measured), range / 60);
  if (!(voxel > 0))
    return 0;
  for (int i = 0; i < 4; ++i) { // surfaces: their number falls with the square
    const auto count = static_cast<double>(VoxelGroups(measured, voxel).size());
    if (count <= 1.1 * static_cast<double>(max_points))
      break;
    voxel *= std::sqrt(count / static_cast<double>(max_points));
  }
  return voxel;
}

FeatureScan
makeFeatureScan(const Points& measured,
                double voxel,
                double normal_radius,
                unsigned int num_threads)
{
  FeatureScan scan;
  ReductionOptions reduction;
  reduction.voxel = voxel;
  scan.points = reducePoints(measured, reduction);
  scan.tree = PointTree(scan.points, num_threads);
  scan.normals.resize(scan.points.size());
  const auto radius_sq = static_cast<float>(normal_radius * normal_radius);
  parallelBlocks(scan.points.size(), kBlockSize, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      scan.normals[i] =
          normalOf(scan.points, scan.tree.withinRadius(scan.points[i], radius_sq));
  });
  return scan;
}

} // namespace pcl6d
