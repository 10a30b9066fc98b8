// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/scene_interpretation/labelled_files.h>
#include <pcl6d/scene_interpretation/pcl/scene_interpreter.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
Interpretation
SceneInterpreter<PointT>::interpret()
{
  Interpretation interpretation = interpretScene(planes_, rules_, options_);
  applyLabels(interpretation, planes_);
  return interpretation;
}

template <typename PointT>
void
SceneInterpreter<PointT>::getLabelledCloud(pcl::PointCloud<pcl::PointXYZL>& cloud) const
{
  const auto& input = inputCloud();
  const std::vector<std::uint32_t> ids = planeIds(planes_, input.size());
  std::vector<std::uint32_t> labels = {0};
  for (const auto& segment : planes_)
    labels.push_back(labelNumber(rules_, segment.plane.label));
  pcl::PointCloud<pcl::PointXYZL> labelled;
  labelled.header = input.header;
  labelled.width = input.width;
  labelled.height = input.height;
  labelled.is_dense = input.is_dense;
  labelled.points.resize(input.size());
  for (std::size_t i = 0; i < input.size(); ++i) {
    labelled[i].getVector3fMap() = input[i].getVector3fMap();
    labelled[i].label = labels[ids[i]];
  }
  cloud = std::move(labelled);
}

template <typename PointT>
RefinedModel
SceneInterpreter<PointT>::refine(pcl::PointCloud<PointT>& cloud) const
{
  const auto& input = inputCloud();
  RefinedModel model = refineModel(planes_, toPoints(input), refinement_options_);
  pcl::PointCloud<PointT> moved = input;
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i].getVector3fMap() = model.points[i];
  cloud = std::move(moved);
  return model;
}

template <typename PointT>
const pcl::PointCloud<PointT>&
SceneInterpreter<PointT>::inputCloud() const
{
  if (!this->input_)
    throw BadArgument("no input cloud: call setInputCloud() first");
  return *this->input_;
}

} // namespace pcl6d
