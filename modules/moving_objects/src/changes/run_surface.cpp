// SPDX-License-Identifier: BSD-3-Clause
#include "run_surface.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <string>

namespace pcl6d {

void
requireComplete(const ComparedRun& run, const char* name)
{
  for (std::size_t i = 0; i < run.size(); ++i) {
    const ComparedScan& scan = run[i];
    const std::string where =
        std::string(name) + ": scan " + std::to_string(i) + " has ";
    if (!scan.points || !scan.normals || !scan.rays)
      throw BadArgument(
          where + "no points, normals or rays, but needs points, normals and rays");
    if (scan.normals->size() != scan.points->size())
      throw BadArgument(where + std::to_string(scan.normals->size()) +
                        " normals, but must have a normal for each of the " +
                        std::to_string(scan.points->size()) + " points");
    if (!isRigid(scan.T_world_scan) || !scan.covariance.allFinite())
      throw BadArgument(
          where +
          "a pose that is not rigid, or a covariance with infinite values or NaN");
  }
}

namespace moving_objects {

RunSurface::RunSurface(const ComparedRun& run, double voxel, unsigned int num_threads)
{
  constexpr std::uint8_t kScansOfVoxel = 4;
  VoxelNumbers voxels;
  std::vector<std::uint8_t> counts;
  for (std::size_t s = 0; s < run.size(); ++s) {
    const Eigen::Matrix3f R = run[s].T_world_scan.linear().cast<float>();
    const Points moved = transformed(*run[s].points, run[s].T_world_scan);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (!moved[i].allFinite())
        continue;
      const auto [number, is_new] = voxels.add(voxelKey(moved[i], voxel));
      if (is_new)
        counts.push_back(0);
      if (counts[number] == kScansOfVoxel)
        continue;
      ++counts[number];
      points_.push_back(moved[i]);
      normals_.emplace_back(R * (*run[s].normals)[i]);
      scans_.push_back(static_cast<std::uint32_t>(s));
    }
  }
  tree_ = PointTree(points_, num_threads);
}

double
poseVariance(const ComparedScan& scan,
             const Eigen::Vector3d& place,
             const Eigen::Vector3d& direction)
{
  Eigen::Matrix<double, 6, 1> j;
  j.head<3>() = direction;
  j.tail<3>() = (place - scan.T_world_scan.translation()).cross(direction);
  // Rounding may make the variance of a nearly singular covariance negative.
  return std::max(0.0, j.dot(scan.covariance * j));
}

} // namespace moving_objects
} // namespace pcl6d
