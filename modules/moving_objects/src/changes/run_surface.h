// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/compared_run.h>
#include <pcl6d/search/point_tree.h>

#include <cstdint>

namespace pcl6d::moving_objects {

/** \brief The points of a run in the world, with a search tree. Of a voxel at most four scans
 * are kept: further scans do not improve the position of the surface, and cost time. */
class RunSurface {
public:
  /** \param[in] voxel [m] of the reduction of the scans */
  RunSurface(const ComparedRun& run, double voxel, unsigned int num_threads);

  const Points&
  points() const
  {
    return points_;
  }
  const Normals&
  normals() const
  {
    return normals_;
  }
  /** \return the scan of each point */
  const std::vector<std::uint32_t>&
  scans() const
  {
    return scans_;
  }
  const PointTree&
  tree() const
  {
    return tree_;
  }

private:
  Points points_;   ///< [m]
  Normals normals_; ///< zero: none
  std::vector<std::uint32_t> scans_;
  PointTree tree_;
};

/** \return variance [m^2] of a point of a scan along a direction, by its pose
 * \param[in] place [m] in the world
 * \param[in] direction unit vector in the world */
double
poseVariance(const ComparedScan& scan,
             const Eigen::Vector3d& place,
             const Eigen::Vector3d& direction);

} // namespace pcl6d::moving_objects
