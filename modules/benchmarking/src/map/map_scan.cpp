// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_scan.h"

#include <pcl6d/common/require.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/types.h>

#include <cmath>

namespace pcl6d::benchmarking {

namespace {
constexpr std::size_t kSample = 2000;
constexpr std::uint64_t kSeed = 1;

Points
finitePoints(const Points& points)
{
  Points finite;
  finite.reserve(points.size());
  for (const auto& p : points)
    if (p.allFinite())
      finite.push_back(p);
  require(finite.size() >= 3, "finite points", finite.size(), ">= 3");
  return finite;
}

IcpModel
surfaceOf(const Points& measured, double voxel)
{
  ReductionOptions reduction;
  reduction.voxel = voxel;
  IcpModel::Options model;
  model.normals = true;
  model.num_threads = 1; // scans are prepared in parallel
  return IcpModel(reducePoints(measured, reduction), model);
}

Points
sampleOf(const Points& measured, double voxel)
{
  const pcl::Indices chosen = VoxelGroups(measured, voxel).chooseRandom(1, kSeed);
  Points sample;
  for (std::size_t i = 0; i < chosen.size(); i += strideFor(chosen.size(), kSample))
    sample.push_back(measured[static_cast<std::size_t>(chosen[i])]);
  return sample;
}
} // namespace

MapScan::MapScan(const Points& cloud, double voxel)
: measured(finitePoints(cloud))
, tree(measured, 1)
, surface(surfaceOf(measured, voxel))
, sample(sampleOf(measured, voxel))
, normals(estimateNormals(sample, surface.points(), surface.tree(), 20, 1))
{}

void
MeasuredDistances::append(const MeasuredDistances& other)
{
  point.insert(point.end(), other.point.begin(), other.point.end());
  plane.insert(plane.end(), other.plane.begin(), other.plane.end());
  looked += other.looked;
}

SurfaceDistances
MeasuredDistances::statistics(double within) const
{
  SurfaceDistances distances;
  distances.point = distanceStatistics(point, within);
  distances.plane = distanceStatistics(plane, within);
  distances.matched = static_cast<double>(point.size()) / static_cast<double>(looked);
  return distances;
}

MeasuredDistances
distancesBetween(const MapScan& scan,
                 const MapScan& target,
                 const Eigen::Isometry3d& T_target_scan,
                 double max_distance,
                 std::size_t most,
                 Faces faces)
{
  const auto limit_sq = static_cast<float>(max_distance * max_distance);
  const Eigen::Matrix3f R = T_target_scan.linear().cast<float>();
  MeasuredDistances result;
  const std::size_t stride = strideFor(scan.sample.size(), most);
  for (std::size_t i = 0; i < scan.sample.size(); i += stride) {
    const Eigen::Vector3f p =
        (T_target_scan * scan.sample[i].cast<double>()).cast<float>();
    ++result.looked;
    const Neighbour on = target.surface.tree().nearest(p, limit_sq);
    const Neighbour next = target.tree.nearest(p, limit_sq);
    if (on.index < 0 || next.index < 0)
      continue;
    const Eigen::Vector3f& normal = target.surface.normals()[on.index];
    if (faces == Faces::kApart && normal.dot(R * scan.normals[i]) < 0)
      continue; // the opposite face of a wall
    result.point.push_back(std::sqrt(next.distance_sq));
    if (!normal.isZero())
      result.plane.push_back(
          std::abs(normal.dot(p - target.surface.points()[on.index])));
  }
  return result;
}

} // namespace pcl6d::benchmarking
