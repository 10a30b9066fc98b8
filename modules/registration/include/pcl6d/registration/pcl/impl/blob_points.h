// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>

#include <pcl/common/io.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <string>

/** \file
 * What rejectors of pairs make of the clouds that PCL's pipelines hand over. */
namespace PCL6D_EXPORTS pcl6d {
namespace registration {

/** \return a cloud as PCL's pipelines hand it over, as points of a type
 * \param[in] field that it must have \throws BadArgument it is null, or has no such field */
template <typename PointT>
typename pcl::PointCloud<PointT>::ConstPtr
cloudOfBlob(const pcl::PCLPointCloud2::ConstPtr& blob, const std::string& field)
{
  if (!blob)
    throw BadArgument("the cloud for a correspondence rejector is null");
  if (pcl::getFieldIndex(*blob, field) < 0)
    throw BadArgument("the cloud for a correspondence rejector has no field " + field);
  const auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  pcl::fromPCLPointCloud2(*blob, *cloud);
  return cloud;
}

} // namespace registration
} // namespace pcl6d
