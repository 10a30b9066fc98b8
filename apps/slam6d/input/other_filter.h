// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <functional>
#include <string>

namespace pcl6d::app {

/** \brief A filter of a plug-in (ScanFilter) with its word. */
struct OtherFilter {
  std::string name;
  std::function<pcl::PCLPointCloud2(const pcl::PCLPointCloud2&)> filter; ///< null: none
};

} // namespace pcl6d::app
