// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/graph_relaxation/scan_link.h>

namespace pcl6d {

const char*
toString(LinkKind kind)
{
  switch (kind) {
  case LinkKind::kSequence:
    return "sequence";
  case LinkKind::kNetwork:
    return "network";
  case LinkKind::kLoop:
    return "loop";
  case LinkKind::kGiven:
    return "given";
  }
  return "unknown";
}

const char*
toString(LinkVerdict verdict)
{
  switch (verdict) {
  case LinkVerdict::kUsed:
    return "used";
  case LinkVerdict::kOdometry:
    return "odometry";
  case LinkVerdict::kRefused:
    return "refused";
  }
  return "unknown";
}

} // namespace pcl6d
