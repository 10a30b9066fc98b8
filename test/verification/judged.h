// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/link_evidence.h>

namespace pcl6d::test {

inline const double kBackground = contradictionBackground({});

inline LinkTestResult
evaluated(const LinkEvidence& evidence)
{
  return testLink(evidence, kBackground);
}

} // namespace pcl6d::test
