// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Classification of a measured point by other scans.
 * \ingroup moving_objects */
enum class PointMotion : std::uint8_t {
  kUnknown, ///< no other scan observed its position
  kStatic,  ///< its surface was measured at other times, too
  kDynamic  ///< its position was free at other times: the object moved
};

/** \return "unknown", "static" or "dynamic" */
const char*
toString(PointMotion motion);

} // namespace pcl6d
