// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_key.h>

#include <vector>

namespace pcl6d::registration {

/** \brief The cubes of a regular grid that hold points: one level of an octree, as a
 * hash table. The grid has a corner at the given origin; points farther than 2^20
 * cubes from the origin, or not finite, are left out. */
class OctreeLevel {
public:
  OctreeLevel(const Points& points, const Eigen::Vector3d& origin, double edge);

  /** \return the number of points [m], moved by T, in the cubes */
  int
  count(const std::vector<Eigen::Vector3d>& points, const Eigen::Isometry3d& T) const;

  /** \return the centres [m] of at most count cubes, spread evenly: the choice depends
   * on the cubes alone */
  std::vector<Eigen::Vector3d>
  centres(std::size_t count) const;

private:
  std::size_t
  slotOf(VoxelKey key) const;

  Eigen::Vector3d origin_;
  double edge_;
  int shift_ = 63;              ///< shift of the hash to the size of the table
  std::vector<VoxelKey> cubes_; ///< ascending
  std::vector<VoxelKey> table_; ///< open addressing
};

} // namespace pcl6d::registration
