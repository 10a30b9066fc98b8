// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/instantiate.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/global_registration/feature_scale.h>

#include <pcl/pcl_base.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Estimates radii for the normals and descriptors of a cloud: estimateFeatureScales()
 * with the calls of PCL's classes, whose setRadiusSearch() needs a known radius.
 *
 * Ranges count from the sensor_origin_ of the cloud. Indices are honoured.
 * \code
 * pcl6d::FeatureScaleEstimation<pcl::PointXYZ> estimation;
 * estimation.setInputCloud(cloud);
 * const pcl6d::FeatureScale scale = estimation.compute().at(0);
 * grid.setLeafSize(scale.voxel, scale.voxel, scale.voxel);
 * normals.setRadiusSearch(scale.normal_radius);
 * fpfh.setRadiusSearch(scale.feature_radius);
 * \endcode
 * \ingroup global_registration */
template <typename PointT>
class FeatureScaleEstimation : public pcl::PCLBase<PointT> {
public:
  using Ptr = pcl::shared_ptr<FeatureScaleEstimation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const FeatureScaleEstimation<PointT>>;

  /** \brief The largest number of scales, each twice the previous scale; 1 unless set.
   * \throws BadArgument 0 */
  void
  setMaximumScales(std::size_t count)
  {
    require(count > 0, "maximum of scales", count, "> 0");
    count_ = count;
  }
  std::size_t
  getMaximumScales() const
  {
    return count_;
  }

  /** \return the finest first; empty for points without extent
   * \throws BadArgument no cloud is set, or an index is out of range */
  std::vector<FeatureScale>
  compute()
  {
    require(this->input_ != nullptr, "input cloud", "null", "set");
    if (!this->initCompute())
      return {};
    requireIndices(*this->indices_, this->input_->size());
    Points points = toPoints(*this->input_, *this->indices_);
    for (auto& p : points)
      p -= this->input_->sensor_origin_.template head<3>();
    this->deinitCompute();
    return estimateFeatureScales(points, count_);
  }

private:
  std::size_t count_ = 1;
};

PCL6D_DECLARE_INSTANCES(FeatureScaleEstimation)
} // namespace pcl6d
