// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/leaf_cells.h>

#include <pcl/filters/filter.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::ApproximateVoxelGrid with its setters and getters, but exact: every occupied
 * leaf gives one point.
 *
 * PCL's class keeps 512 leaves at a time and drops one at a hash collision. A leaf then gives
 * several points, depending on the order of the input. This class gives the points of
 * pcl::VoxelGrid (LeafCells) in its order, x running fastest. Further differences: chosen indices
 * are respected, points that are not finite are left out and the output is dense, sums of x, y, z
 * are in double, mean normals have length 1, and with setDownsampleAllData(false) fields other than
 * x, y, z keep the defaults of the point type.
 * \code
 * pcl6d::ApproximateVoxelGrid<pcl::PointXYZI> grid;
 * grid.setLeafSize(0.2f, 0.2f, 0.2f); // [m]
 * grid.setInputCloud(cloud);
 * grid.filter(reduced);
 * \endcode \ingroup filters */
template <typename PointT>
class ApproximateVoxelGrid : public pcl::Filter<PointT> {
public:
  using typename pcl::Filter<PointT>::PointCloud;
  using Ptr = pcl::shared_ptr<ApproximateVoxelGrid<PointT>>;
  using ConstPtr = pcl::shared_ptr<const ApproximateVoxelGrid<PointT>>;

  ApproximateVoxelGrid();

  /** \brief Sides of a leaf [m]; 1 each unless set. */
  void
  setLeafSize(const Eigen::Vector3f& leaf)
  {
    leaf_ = leaf;
  }
  void
  setLeafSize(float x, float y, float z)
  {
    leaf_ = {x, y, z};
  }
  Eigen::Vector3f
  getLeafSize() const
  {
    return leaf_;
  }

  /** \brief Whether every field is averaged, or x, y, z alone; true unless set. */
  void
  setDownsampleAllData(bool downsample)
  {
    downsample_all_ = downsample;
  }
  bool
  getDownsampleAllData() const
  {
    return downsample_all_;
  }

protected:
  /** \throws BadArgument see LeafCells(), or an index is out of range */
  void
  applyFilter(PointCloud& output) override;

private:
  Eigen::Vector3f leaf_ = Eigen::Vector3f::Ones();
  bool downsample_all_ = true;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/approximate_voxel_grid.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(ApproximateVoxelGrid)
} // namespace pcl6d
