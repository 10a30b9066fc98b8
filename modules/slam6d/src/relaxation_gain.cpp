// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation_gain.h"

#include <pcl6d/common/components.h>

#include <vector>

namespace pcl6d::slam6d {

namespace {
/** So much must be gained, or the poses stay: what is less is the noise of closest points.
 * Gain: the share by which the rms of all links falls, and agreement rises. hku1 matched
 * against all scans: 0.2 %, and its poses are as good before; against the last ten: 0.7 %,
 * and the position rms falls from 39 to 33 mm; the demo: 0.6 %, 14 to 10 mm. */
constexpr double kLeastGain = 0.004;

double
gainOf(const GraphSlamResult& relaxed, const StageResult& stage)
{
  const auto share = [](double from, double to) {
    return from > 0 ? (to - from) / from : 0;
  };
  return share(stage.agreement_before, stage.agreement_after) -
         share(relaxed.rms_before, relaxed.rms);
}

/** \return whether links close a cycle: a tree has nothing to spread */
bool
hasCycle(const std::vector<LinkReport>& links, std::size_t num_scans)
{
  Components components(num_scans);
  for (const LinkReport& link : links)
    if (link.used && !components.join(link.from, link.to))
      return true;
  return false;
}
} // namespace

std::string
whyNotTaken(const GraphSlamResult& relaxed, const StageResult& stage)
{
  if (relaxed.status == Status::kDiverged || relaxed.status == Status::kTooFewPairs)
    return std::string("relaxation: ") + toString(relaxed.status);
  if (!hasCycle(relaxed.links, relaxed.poses.size()))
    return "the links close no cycle";
  return gainOf(relaxed, stage) < kLeastGain ? "the links agreed already" : "";
}

} // namespace pcl6d::slam6d
