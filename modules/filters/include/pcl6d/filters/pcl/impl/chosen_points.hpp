// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/leaf_cells.h>

#include <pcl/point_cloud.h>

namespace PCL6D_EXPORTS pcl6d {

/** \return whether the indices are 0, 1, 2, ... of every point */
inline bool
areAllInOrder(const pcl::Indices& indices, std::size_t num_points)
{
  if (indices.size() != num_points)
    return false;
  pcl::index_t differs = 0; // without a branch, many at a time
  for (std::size_t i = 0; i < num_points; ++i)
    differs |= indices[i] ^ static_cast<pcl::index_t>(i);
  return differs == 0;
}

/** \return the points of a cloud in place; valid during its lifetime */
template <typename PointT>
CoordinateView
viewOf(const pcl::PointCloud<PointT>& cloud)
{
  static_assert(sizeof(PointT) % sizeof(float) == 0, "points are rows of floats");
  return {cloud.empty() ? nullptr : cloud.front().getVector3fMap().data(),
          sizeof(PointT) / sizeof(float),
          cloud.size()};
}

/** \brief The chosen points of a cloud for the core: in place if every point is chosen, else
 * copied. Valid during the lifetime of the cloud. */
template <typename PointT>
class ChosenPoints {
public:
  /** \throws BadArgument an index is out of range */
  ChosenPoints(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
  {
    if (areAllInOrder(indices, cloud.size())) {
      view_ = viewOf(cloud);
      return;
    }
    requireIndices(indices, cloud.size());
    copied_ = toPoints(cloud, indices);
    view_ = viewOf(copied_);
  }
  ChosenPoints(const ChosenPoints&) = delete;
  ChosenPoints&
  operator=(const ChosenPoints&) = delete;

  const CoordinateView&
  view() const
  {
    return view_;
  }

private:
  Points copied_;
  CoordinateView view_;
};

} // namespace pcl6d
