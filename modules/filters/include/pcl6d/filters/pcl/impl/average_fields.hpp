// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/leaf_cells.h>

#include <pcl/common/centroid.h>
#include <pcl/type_traits.h>

#include <boost/mpl/size.hpp>

#include <cstdint>
#include <vector>

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
 * \param[in] points of the core, Points or a CoordinateView; their mean is summed in
 * double, where PCL's float sum drifts away far from the origin
 * \param[in] pointOf the PCL point of a member */
template <typename Places, typename PointT, typename PointOf>
void
averageMembers(const Places& points,
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

/** Gives each cell's point the mean fields of the cell's points. */
template <typename PointT>
void
averageFields(const pcl::PointCloud<PointT>& cloud,
              const pcl::Indices& chosen,
              const LeafOrder& order,
              pcl::PointCloud<PointT>& means)
{
  const std::vector<std::uint32_t>& ranks = order.ranks();
  std::vector<pcl::CentroidPoint<PointT>> sums(order.size());
  for (std::size_t i = 0; i < ranks.size(); ++i)
    if (ranks[i] < order.size())
      sums[ranks[i]].add(cloud[chosen[i]]);
  for (std::size_t c = 0; c < order.size(); ++c)
    sums[c].get(means[c]);
}

/** Makes one point per cell, the mean of the cell's points; x, y, z are
 * summed in double.
 * \param[in] chosen, points the chosen points of the cloud, in order
 * \param[in] all_fields false: x, y, z alone \param[out] means not the cloud itself */
template <typename PointT>
void
averageCells(const pcl::PointCloud<PointT>& cloud,
             const pcl::Indices& chosen,
             const CoordinateView& points,
             const LeafOrder& order,
             bool all_fields,
             pcl::PointCloud<PointT>& means)
{
  means.clear();
  means.resize(order.size());
  if constexpr (!hasOnlyCoordinates<PointT>())
    if (all_fields)
      averageFields(cloud, chosen, order, means);
  if (order.size() > 0)
    order.writeMeans(
        points, means.front().getVector3fMap().data(), sizeof(PointT) / sizeof(float));
}

} // namespace pcl6d
