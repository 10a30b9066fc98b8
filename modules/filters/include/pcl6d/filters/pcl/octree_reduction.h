// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/filters/filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Octree reduction (book 4.1.5) as a pcl::Filter: one point per occupied voxel.
 *
 * Unlike pcl::VoxelGrid it does not overflow on large extents (64-bit keys; what does
 * not fit is an error), and can keep measured points. Fields other than x, y, z are
 * averaged with kMean and taken from the voxel's first point with kCentre. \code
 * pcl6d::OctreeReduction<pcl::PointXYZI> reduction;
 * reduction.options().voxel = 0.1;
 * reduction.setInputCloud(cloud);
 * reduction.filter(reduced);
 * \endcode \ingroup filters */
template <typename PointT>
class OctreeReduction : public pcl::Filter<PointT> {
public:
  using typename pcl::Filter<PointT>::PointCloud;
  using Ptr = pcl::shared_ptr<OctreeReduction<PointT>>;

  OctreeReduction();

  ReductionOptions&
  options()
  {
    return options_;
  }

protected:
  /** \throws BadArgument an option breaks its rule, an index is not that of a point, or
   * a point lies outside the grid */
  void
  applyFilter(PointCloud& output) override;

private:
  ReductionOptions options_;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/octree_reduction.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(OctreeReduction)
} // namespace pcl6d
