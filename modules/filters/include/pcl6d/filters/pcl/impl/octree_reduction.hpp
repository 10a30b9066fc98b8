// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/impl/average_fields.hpp>
#include <pcl6d/filters/pcl/impl/chosen_points.hpp>
#include <pcl6d/filters/pcl/octree_reduction.h>

#include <pcl/common/io.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
OctreeReduction<PointT>::OctreeReduction()
{
  this->filter_name_ = "OctreeReduction";
}

/** \return the chosen points; NaN where the field is outside its limits */
template <typename PointT>
Points
OctreeReduction<PointT>::chosenPoints() const
{
  const auto& input = *this->input_;
  const pcl::Indices& chosen = *this->indices_;
  requireIndices(chosen, input.size());
  Points points(chosen.size()); // where toPoints() would ask for room at each point
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointT& p = input[chosen[i]];
    points[i] = {p.x, p.y, p.z};
  }
  if (field_.empty())
    return points;
  std::vector<pcl::PCLPointField> fields;
  const int field = pcl::getFieldIndex<PointT>(field_, fields);
  require(field >= 0, "filter field", field_, "a field of the points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    float value = 0; // float like in PCL, whatever the field's type
    std::memcpy(&value,
                reinterpret_cast<const char*>(&input[chosen[i]]) + fields[field].offset,
                sizeof(value));
    if (!isWithinLimits(value))
      points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return points;
}

template <typename PointT>
void
OctreeReduction<PointT>::applyFilter(PointCloud& output)
{
  options_.validate();
  PointCloud reduced; // the output may be the input
  reduced.header = this->input_->header;
  reduced.sensor_origin_ = this->input_->sensor_origin_;
  reduced.sensor_orientation_ = this->input_->sensor_orientation_;
  reduced.is_dense = true;
  if (!hasLeaf())
    reduceByVoxel(chosenPoints(), reduced);
  else if (field_.empty())
    reduceByLeaf(ChosenPoints<PointT>(*this->input_, *this->indices_).view(), reduced);
  else
    reduceByLeaf(viewOf(chosenPoints()), reduced);
  reduced.width = static_cast<std::uint32_t>(reduced.size());
  reduced.height = 1;
  output.swap(reduced);
}

template <typename PointT>
void
OctreeReduction<PointT>::reduceByVoxel(const Points& points, PointCloud& output) const
{
  const auto pointOf = [&](pcl::index_t i) -> const PointT& {
    return (*this->input_)[(*this->indices_)[i]];
  };
  if (options_.method == ReductionMethod::kMean && hasOnlyCoordinates<PointT>()) {
    const Points means = reducePoints(points, options_);
    output.resize(means.size());
    for (std::size_t i = 0; i < means.size(); ++i)
      output[i].getVector3fMap() = means[i];
    return;
  }
  const VoxelGroups groups(points, options_.voxel);
  if (options_.method == ReductionMethod::kRandom) {
    for (const auto i : groups.chooseRandom(options_.points_per_voxel, options_.seed))
      output.push_back(pointOf(i));
    return;
  }
  output.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const IndexRange members = groups.indices(g);
    PointT& point = output[g] = pointOf(*members.begin());
    if (options_.method == ReductionMethod::kMean)
      averageMembers(points, members, pointOf, point);
    else
      point.getVector3fMap() = voxelCentre(groups.key(g), options_.voxel);
  }
}

/** Reduces like pcl::VoxelGrid. */
template <typename PointT>
void
OctreeReduction<PointT>::reduceByLeaf(const CoordinateView& points, PointCloud& output)
{
  this->findCells(points);
  const LeafOrder order(points, this->cells());
  const bool takes_means = options_.method == ReductionMethod::kMean;
  if (takes_means && least_points_ < 2 && !getSaveLeafLayout())
    return averageCells(
        *this->input_, *this->indices_, points, order, downsample_all_, output);
  const auto pointOf = [&](pcl::index_t i) -> const PointT& {
    return (*this->input_)[(*this->indices_)[i]];
  };
  const LeafGroups groups(order);
  const std::vector<std::size_t> kept = this->keptGroups(groups, points);
  if (options_.method == ReductionMethod::kRandom) {
    for (const auto i : groups.chooseRandom(
             kept, points, this->cells(), options_.points_per_voxel, options_.seed))
      output.push_back(pointOf(i));
    return;
  }
  output.resize(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const IndexRange members = groups.indices(kept[k]);
    const PointT& first = pointOf(*members.begin());
    PointT& point = output[k];
    if (downsample_all_)
      point = first;
    if (!takes_means)
      point.getVector3fMap() =
          this->cells()
              .centreOf(this->cells().cellOf(first.getVector3fMap()))
              .template cast<float>();
    else if (downsample_all_)
      averageMembers(points, members, pointOf, point);
    else
      point.getVector3fMap() = meanOf(points, members);
  }
}

} // namespace pcl6d
