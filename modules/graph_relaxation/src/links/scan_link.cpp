// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/graph_relaxation/scan_link.h>

namespace pcl6d {

const char*
toString(LinkKind kind)
{
  constexpr Named<LinkKind> kKinds[] = {{LinkKind::kSequence, "sequence"},
                                        {LinkKind::kNetwork, "network"},
                                        {LinkKind::kLoop, "loop"},
                                        {LinkKind::kGiven, "given"}};
  return nameOf(kKinds, kind);
}

const char*
toString(LinkVerdict verdict)
{
  constexpr Named<LinkVerdict> kVerdicts[] = {{LinkVerdict::kUsed, "used"},
                                              {LinkVerdict::kOdometry, "odometry"},
                                              {LinkVerdict::kRefused, "refused"}};
  return nameOf(kVerdicts, verdict);
}

} // namespace pcl6d
