// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/moving_objects/pcl/moving_point_filter.h>

#include <pcl/types.h>

#include <algorithm>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
MovingPointFilter<PointT>::MovingPointFilter(bool extract_removed_indices)
: pcl::FilterIndices<PointT>(extract_removed_indices)
{
  this->filter_name_ = "MovingPointFilter";
}

template <typename PointT>
std::size_t
MovingPointFilter<PointT>::addScan(const PointCloudConstPtr& cloud,
                                   const Eigen::Isometry3d& T_world_scan,
                                   const PoseSigma& sigma)
{
  require(cloud != nullptr, "cloud of the scan", "null", "set");
  const Eigen::Vector3f own = cloud->sensor_origin_.template head<3>();
  const std::size_t scan =
      scans_.add(toPoints(*cloud), T_world_scan, sigma, origin_.value_or(own));
  clouds_.push_back(cloud);
  return scan;
}

template <typename PointT>
void
MovingPointFilter<PointT>::requireScan(std::size_t scan) const
{
  require(scan < size(), "scan", scan, "one of " + std::to_string(size()));
}

template <typename PointT>
void
MovingPointFilter<PointT>::setInputScan(std::size_t scan)
{
  requireScan(scan);
  setInputScan(scan, clouds_[scan]);
}

template <typename PointT>
void
MovingPointFilter<PointT>::setInputScan(std::size_t scan,
                                        const PointCloudConstPtr& cloud)
{
  requireScan(scan);
  require(cloud != nullptr, "input cloud", "null", "set");
  chosen_ = scan;
  chosen_cloud_ = cloud;
  this->setInputCloud(cloud);
}

template <typename PointT>
std::vector<PointMotion>
MovingPointFilter<PointT>::motion(std::size_t scan)
{
  requireScan(scan);
  return scans_.motion(scan, toPoints(*clouds_[scan]));
}

template <typename PointT>
std::size_t
MovingPointFilter<PointT>::scanOfInput() const
{
  if (this->input_ == chosen_cloud_)
    return chosen_;
  const auto found = std::find(clouds_.begin(), clouds_.end(), this->input_);
  require(found != clouds_.end(),
          "input cloud",
          "another",
          "that of an added scan, or come with its number by setInputScan()");
  return static_cast<std::size_t>(found - clouds_.begin());
}

template <typename PointT>
void
MovingPointFilter<PointT>::applyFilter(pcl::Indices& indices)
{
  requireIndices(*this->indices_, this->input_->size());
  const Points points = toPoints(*this->input_);
  const std::vector<PointMotion> motion = scans_.motion(scanOfInput(), points);
  indices.clear();
  this->removed_indices_->clear();
  for (const auto index : *this->indices_) {
    const bool moved = motion[index] == PointMotion::kDynamic;
    if (points[index].allFinite() && moved == this->negative_)
      indices.push_back(index);
    else if (this->extract_removed_indices_)
      this->removed_indices_->push_back(index);
  }
}

} // namespace pcl6d
