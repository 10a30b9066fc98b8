// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/pcl/leaf_grid.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/filters/filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Octree reduction (book 4.1.5) as a pcl::Filter: one point per occupied voxel.
 *
 * After setLeafSize() the filter is equivalent to pcl::VoxelGrid in voxels, points, order and
 * setters (LeafGrid). Otherwise options() give the voxel, a cube. Unlike pcl::VoxelGrid the filter
 * does not overflow on large extents (a point outside the grid is an error), sums in double, and
 * can keep measured points. Fields other than x, y, z are averaged with kMean and taken from the
 * voxel's first point with kCentre.
 * \code
 * pcl6d::OctreeReduction<pcl::PointXYZI> reduction;
 * reduction.setLeafSize(0.1f, 0.1f, 0.1f);
 * reduction.setInputCloud(cloud);
 * reduction.filter(reduced);
 * \endcode \ingroup filters */
template <typename PointT>
class OctreeReduction : public pcl::Filter<PointT>, public LeafGrid {
public:
  using typename pcl::Filter<PointT>::PointCloud;
  using Ptr = pcl::shared_ptr<OctreeReduction<PointT>>;
  using ConstPtr = pcl::shared_ptr<const OctreeReduction<PointT>>;

  OctreeReduction();

  ReductionOptions&
  options()
  {
    return options_;
  }

protected:
  /** \throws BadArgument an option is invalid, an index is out of range, the point type has no
   * field to filter by, or a point lies outside the grid */
  void
  applyFilter(PointCloud& output) override;

private:
  Points
  chosenPoints() const;
  void
  reduceByVoxel(const Points& points, PointCloud& output) const;
  void
  reduceByLeaf(const CoordinateView& points, PointCloud& output);

  ReductionOptions options_;
};

/** \brief OctreeReduction for clouds with fields known only at run time: every field is averaged in
 * double, by its type, colours by channel.
 * \ingroup filters */
template <>
class OctreeReduction<pcl::PCLPointCloud2> : public pcl::Filter<pcl::PCLPointCloud2>,
                                             public LeafGrid {
public:
  using Ptr = pcl::shared_ptr<OctreeReduction<pcl::PCLPointCloud2>>;
  using ConstPtr = pcl::shared_ptr<const OctreeReduction<pcl::PCLPointCloud2>>;

  OctreeReduction() { this->filter_name_ = "OctreeReduction"; }

  ReductionOptions&
  options()
  {
    return options_;
  }

protected:
  /** \throws BadArgument see OctreeReduction, or x, y, z are no fields of type float or double */
  void
  applyFilter(pcl::PCLPointCloud2& output) override;

private:
  ReductionOptions options_;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/octree_reduction.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(OctreeReduction)
} // namespace pcl6d
