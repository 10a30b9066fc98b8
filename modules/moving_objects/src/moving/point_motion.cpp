// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/moving_objects/point_motion.h>

namespace pcl6d {

const char*
toString(PointMotion motion)
{
  switch (motion) {
  case PointMotion::kStatic:
    return "static";
  case PointMotion::kDynamic:
    return "dynamic";
  case PointMotion::kUnknown:
    break;
  }
  return "unknown";
}

} // namespace pcl6d
