// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <pcl/common/centroid.h>
#include <pcl/type_traits.h>

#include <boost/mpl/size.hpp>

namespace PCL6D_EXPORTS pcl6d {

/** \return whether a point has no fields beside x, y, z */
template <typename PointT>
constexpr bool
hasOnlyCoordinates()
{
  using Fields = typename pcl::traits::fieldList<PointT>::type;
  return boost::mpl::size<Fields>::value == 3;
}

/** Gives a point the mean fields of the members, and their mean place.
 * \param[in] points of the core; their mean is summed in double, where PCL's float sum
 * drifts away far from the origin \param[in] pointOf the PCL point of a member */
template <typename PointT, typename PointOf>
void
averageMembers(const Points& points,
               const IndexRange& members,
               const PointOf& pointOf,
               PointT& point)
{
  if constexpr (!hasOnlyCoordinates<PointT>()) {
    pcl::CentroidPoint<PointT> mean;
    for (const auto i : members)
      mean.add(pointOf(i));
    mean.get(point);
  }
  point.getVector3fMap() = meanOf(points, members);
}

} // namespace pcl6d
