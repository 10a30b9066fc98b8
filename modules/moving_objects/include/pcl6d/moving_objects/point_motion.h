// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Classification of a measured point by other scans.
 * \ingroup moving_objects */
enum class PointMotion : std::uint8_t {
  kUnknown, ///< not observed by another scan
  kStatic,  ///< on a surface that other scans measured, too
  kDynamic  ///< in space that was free at other times: the object moved
};

/** \return "unknown", "static" or "dynamic" */
const char*
toString(PointMotion motion);

} // namespace pcl6d
