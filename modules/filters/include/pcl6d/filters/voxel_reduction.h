// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_key.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d {

/** \brief What stands for the points of an occupied voxel (book 4.1.5). */
enum class ReductionMethod {
  kCentre, ///< the centre of the voxel: regular, moves points up to voxel sqrt(3) / 2
  kMean,   ///< the mean of the voxel's points: always inside the voxel
  kRandom  ///< measured points chosen at random: no averaging across surfaces
};

/** \brief Knobs of the octree reduction. */
struct ReductionOptions {
  double voxel = 0.1; ///< [m] edge length of a voxel; finite, > 0
  ReductionMethod method = ReductionMethod::kMean;
  int points_per_voxel = 1; ///< kept by kRandom; >= 1
  std::uint64_t seed = 0;   ///< of kRandom
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The points of a cloud sorted into the occupied voxels of a regular grid,
 * which has a corner at the origin. Voxels come in the order of their keys, points in
 * their own order, so nothing depends on threads or hashing. Points that are not finite
 * are left out. */
class VoxelGroups {
public:
  /** \throws BadArgument a point does not fit into the grid (see voxelKey()) */
  VoxelGroups(const Points& points, double voxel);

  /** \return the number of occupied voxels */
  std::size_t
  size() const;

  VoxelKey
  key(std::size_t group) const;

  /** \return the places of the group's points in the input, ascending */
  pcl::Indices
  indices(std::size_t group) const;

  /** \brief Chooses at most count points of a group. The choice depends only on the
   * seed, the voxel and its points. \return ascending places in the input */
  pcl::Indices
  chooseRandom(std::size_t group, int count, std::uint64_t seed) const;

private:
  struct Member {
    VoxelKey key;
    int index;
  };
  std::vector<Member> members_;
  std::vector<std::size_t> begin_; ///< first member of each group, and the end
};

/** \return the mean [m] of the chosen points, which must be one at least; summed in double
 */
Eigen::Vector3f
meanOf(const Points& points, const pcl::Indices& indices);

/** \brief Reduces points to one (kRandom: a few) per occupied voxel.
 * \throws BadArgument an option breaks its rule, or a point lies outside the grid
 * \note Source: book 4.1.5; the grid is the leaf level of an octree. */
Points
reducePoints(const Points& points, const ReductionOptions& options);

} // namespace pcl6d
