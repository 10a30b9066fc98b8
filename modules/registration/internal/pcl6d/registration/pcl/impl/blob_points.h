// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>

#include <pcl/common/io.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <string>

/** \file
 * Conversion of the clouds from PCL's pipelines, for rejectors of pairs. */
namespace PCL6D_EXPORTS pcl6d {
namespace registration {

/** \return a cloud from PCL's pipelines, as points of a type
 * \param[in] field mandatory field \throws BadArgument the cloud is null, or lacks the field */
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
