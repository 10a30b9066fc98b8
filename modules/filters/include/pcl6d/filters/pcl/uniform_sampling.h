// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/filters/leaf_cells.h>

#include <pcl/filters/filter_indices.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief pcl::UniformSampling: of each occupied cube of a grid, the point nearest to its
 * centre.
 *
 * The cubes are identical to PCL's class (LeafCells). Differences: distances to the centre are in
 * double, where PCL adds 1 to their squares in float and thus keeps the first point in cubes of
 * millimetres; of equally near points the first stays; large extents do not overflow; points come
 * in the order of the input, not of a hash table. A pcl::FilterIndices, like PCL's own class in
 * later versions: filter(indices), negative and organized output work likewise. Points that are not
 * finite never pass.
 * \code
 * pcl6d::UniformSampling<pcl::PointXYZ> sampling;
 * sampling.setRadiusSearch(0.01); // [m] side of a cube
 * sampling.setInputCloud(cloud);
 * sampling.filter(key_points);
 * \endcode \ingroup filters */
template <typename PointT>
class UniformSampling : public pcl::FilterIndices<PointT> {
public:
  using Ptr = pcl::shared_ptr<UniformSampling<PointT>>;
  using ConstPtr = pcl::shared_ptr<const UniformSampling<PointT>>;

  /** \param[in] extract_removed_indices fill getRemovedIndices() */
  explicit UniformSampling(bool extract_removed_indices = false);

  /** \brief Side of a cube [m], called radius in PCL; must be set. */
  virtual void
  setRadiusSearch(double radius)
  {
    radius_ = radius;
  }
  double
  getRadiusSearch() const
  {
    return radius_;
  }

protected:
  /** \throws BadArgument see LeafCells(), or an index is out of range */
  void
  applyFilter(pcl::Indices& indices) override;

private:
  double radius_ = 0;
};

} // namespace pcl6d
#include <pcl6d/filters/pcl/impl/uniform_sampling.hpp>
namespace PCL6D_EXPORTS pcl6d {
PCL6D_DECLARE_INSTANCES(UniformSampling)
} // namespace pcl6d
