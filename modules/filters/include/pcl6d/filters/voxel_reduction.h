// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_key.h>

#include <pcl/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The point that represents an occupied voxel (book 4.1.5). */
enum class ReductionMethod {
  kCentre, ///< the centre of the voxel: regular, moves points up to voxel sqrt(3) / 2
  kMean,   ///< the mean of the voxel's points: always inside the voxel
  kRandom  ///< measured points chosen at random: no averaging across surfaces
};

/** \return the method called "mean", "centre" or "random" \throws BadArgument another */
ReductionMethod
reductionMethodFromName(const std::string& name);

/** \return the names of the methods */
std::vector<std::string>
reductionMethodNames();

/** \return the method's name */
std::string
toString(ReductionMethod method);

/** \brief Knobs of the octree reduction. */
struct ReductionOptions {
  double voxel = 0.1; ///< [m] edge length of a voxel; finite, > 0
  ReductionMethod method = ReductionMethod::kMean;
  int points_per_voxel = 1; ///< kept by kRandom; >= 1
  std::uint64_t seed = 0;   ///< of kRandom
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A part of a list of indices, to be walked through. */
class IndexRange {
public:
  IndexRange(const pcl::index_t* begin, const pcl::index_t* end)
  : begin_(begin), end_(end)
  {}

  const pcl::index_t*
  begin() const
  {
    return begin_;
  }

  const pcl::index_t*
  end() const
  {
    return end_;
  }

  std::size_t
  size() const
  {
    return static_cast<std::size_t>(end_ - begin_);
  }

private:
  const pcl::index_t* begin_;
  const pcl::index_t* end_;
};

/** \brief The points of a cloud sorted into the occupied voxels of a regular grid with a corner at
 * the origin. Voxels come in the order of their keys, points in the order of the cloud,
 * independent of threads or hashing. Points that are not finite are left out. */
class VoxelGroups {
public:
  /** \throws BadArgument a point does not fit into the grid (see voxelKey()) */
  VoxelGroups(const Points& points, double voxel);

  /** \return the number of occupied voxels */
  std::size_t
  size() const
  {
    return keys_.size();
  }

  VoxelKey
  key(std::size_t group) const
  {
    return keys_[group];
  }

  /** \return the indices of the group's points in the input, ascending; valid during the lifetime
   * of this object */
  IndexRange
  indices(std::size_t group) const
  {
    return {indices_.data() + begin_[group], indices_.data() + begin_[group + 1]};
  }

  /** \brief Chooses at most count points of each group. The choice depends only on the seed, the
   * voxel and the order of its points. \return indices in the input, group by group, ascending
   * inside a group */
  pcl::Indices
  chooseRandom(int count, std::uint64_t seed) const;

private:
  pcl::Indices indices_;            ///< of the finite points, group by group
  std::vector<VoxelKey> keys_;      ///< of each group
  std::vector<pcl::index_t> begin_; ///< first member of each group, and the end
};

/** \return the mean [m] of the chosen points, at least one; summed in double
 */
Eigen::Vector3f
meanOf(const Points& points, const IndexRange& indices);

/** \brief Reduces points to one (kRandom: a few) per occupied voxel.
 * \throws BadArgument an option is invalid, or a point lies outside the grid
 * \note Source: book 4.1.5; the grid is the leaf level of an octree. */
Points
reducePoints(const Points& points, const ReductionOptions& options);

} // namespace pcl6d
