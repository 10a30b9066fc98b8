// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/plane_segmentation/pcl/plane_segmentation.h>

namespace PCL6D_EXPORTS pcl6d {

/** \return a x + b y + c z + d = 0 with the normal towards the sensor */
inline pcl::ModelCoefficients
toModelCoefficients(const PlaneSegment& segment)
{
  const double side = segment.seen_from.dot(segment.plane.normal) < 0 ? -1 : 1;
  pcl::ModelCoefficients coefficients;
  for (int axis = 0; axis < 3; ++axis)
    coefficients.values.push_back(
        static_cast<float>(side * segment.plane.normal[axis]));
  coefficients.values.push_back(static_cast<float>(-side * segment.plane.offset));
  return coefficients;
}

template <typename PointT>
void
PlaneSegmentation<PointT>::segment(PlaneSegments& segments)
{
  require(this->input_ != nullptr, "input cloud", "null", "set");
  if (!this->initCompute())
    throw BadArgument("input cloud has no points, but must have some");
  requireIndices(*this->indices_, this->input_->size());
  PlaneCloudOptions options;
  options.viewpoint = this->input_->sensor_origin_.template head<3>();
  options.num_threads = num_threads_;
  // Points that were not chosen become NaN; the grid stays.
  Points points(this->input_->size(),
                Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  for (const auto index : *this->indices_)
    points[static_cast<std::size_t>(index)] = (*this->input_)[index].getVector3fMap();
  if (this->input_->isOrganized())
    options.width = this->input_->width;
  const PlaneCloud cloud(points, options);
  segments = finishPlanes(cloud, findCandidates(cloud), plane_options_);
  this->deinitCompute();
}

template <typename PointT>
void
PlaneSegmentation<PointT>::segment(std::vector<pcl::ModelCoefficients>& coefficients,
                                   std::vector<pcl::PointIndices>& inliers)
{
  PlaneSegments segments;
  segment(segments);
  coefficients.clear();
  inliers.clear();
  for (const auto& found : segments.planes) {
    coefficients.push_back(toModelCoefficients(found));
    coefficients.back().header = this->input_->header;
    inliers.emplace_back();
    inliers.back().header = this->input_->header;
    inliers.back().indices.assign(found.points.begin(), found.points.end());
  }
}

template <typename PointT>
void
PlaneSegmentation<PointT>::segment(pcl::PointIndices& inliers,
                                   pcl::ModelCoefficients& coefficients)
{
  std::vector<pcl::ModelCoefficients> all_coefficients;
  std::vector<pcl::PointIndices> all_inliers;
  segment(all_coefficients, all_inliers);
  inliers = all_inliers.empty() ? pcl::PointIndices() : all_inliers.front();
  coefficients =
      all_coefficients.empty() ? pcl::ModelCoefficients() : all_coefficients.front();
}

} // namespace pcl6d
