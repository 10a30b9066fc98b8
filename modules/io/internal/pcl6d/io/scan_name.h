// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstdio>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \return "scan007" for 7: the stem of the scan's file names */
inline std::string
scanName(int index)
{
  char name[32];
  std::snprintf(name, sizeof name, "scan%03d", index);
  return name;
}

} // namespace pcl6d
