// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What the other scans say of a measured point. \ingroup moving_objects */
enum class PointMotion : std::uint8_t {
  kUnknown, ///< none of them saw its place
  kStatic,  ///< its surface was there at other times, too
  kDynamic  ///< its place was free at other times: it moved, or was moved
};

/** \return "unknown", "static" or "dynamic" */
const char*
toString(PointMotion motion);

} // namespace pcl6d
