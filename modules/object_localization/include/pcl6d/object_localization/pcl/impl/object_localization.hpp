// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/object_localization/pcl/object_localization.h>
#include <pcl6d/object_localization/pose_covariance.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
void
ObjectLocalization<PointT>::setModelCloud(const PointCloudConstPtr& model,
                                          const std::string& object_class)
{
  require(model != nullptr, "model cloud", "null", "set");
  Points points;
  for (const auto& point : *model)
    points.push_back(point.getVector3fMap());
  setModel(ObjectModel::fromCloud(object_class, points));
}

template <typename PointT>
void
ObjectLocalization<PointT>::setModel(const ObjectModel& model)
{
  localizer_.emplace(model, options_);
}

template <typename PointT>
bool
ObjectLocalization<PointT>::recognize(Transformations& transformations)
{
  require(localizer_.has_value(), "model", "none", "set");
  require(this->input_ != nullptr, "input cloud", "null", "set");
  if (!this->initCompute())
    throw BadArgument("input cloud has no points, but must have some");
  requireIndices(*this->indices_, this->input_->size());
  Eigen::Isometry3d T_cloud_sensor = Eigen::Isometry3d::Identity();
  T_cloud_sensor.linear() =
      this->input_->sensor_orientation_.template cast<double>().toRotationMatrix();
  T_cloud_sensor.translation() =
      this->input_->sensor_origin_.template head<3>().template cast<double>();
  const Eigen::Isometry3d T_sensor_cloud = T_cloud_sensor.inverse();
  Points points;
  std::vector<std::uint32_t> places; // of the finite points
  for (const auto index : *this->indices_) {
    const auto& p = (*this->input_)[index].getVector3fMap();
    if (!p.allFinite())
      continue;
    points.push_back(
        (T_sensor_cloud * p.template cast<double>()).template cast<float>());
    places.push_back(static_cast<std::uint32_t>(index));
  }
  this->deinitCompute();
  objects_ = localizer_->locate(LocalizationScene(points, options_.num_threads));
  transformations.clear();
  for (auto& object : objects_) {
    if (object.covariance)
      object.covariance =
          movedCovariance(*object.covariance, T_cloud_sensor, object.T_scene_object);
    object.T_scene_object = T_cloud_sensor * object.T_scene_object;
    for (auto& point : object.points)
      point = places[point];
    transformations.push_back(object.T_scene_object.matrix().template cast<float>());
  }
  return !objects_.empty();
}

} // namespace pcl6d
