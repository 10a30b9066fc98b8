// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/require.h>

namespace pcl6d::visualization {

/** \throws BadArgument a width or height [px] is outside the range supported by VTK */
inline void
requirePictureSize(const char* name, int size)
{
  require(size >= 200 && size <= 8192, name, size, "200 to 8192");
}

} // namespace pcl6d::visualization
