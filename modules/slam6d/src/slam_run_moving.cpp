// SPDX-License-Identifier: BSD-3-Clause
// What moved while scans were taken, as a run leaves it out.
#include "slam_run.h"

#include <utility>

namespace pcl6d::slam6d {

/** Only relaxation does without what moved. The verdict is by whole scans: at a wrong pose rays go
 * through what stands, which then seems to have moved, and is all that tells against the pose. */
bool
SlamRun::leaveOutMoving()
{
  const auto& scans = verification_.scans();
  if (!moving_.judge(scans, result_) || !moving_.isNoticeable(result_))
    return true;
  const auto still = moving_.still(matcher_->matcher().modelOptions(true));
  GraphStage stage = makeGraphStage(sharing, result_.parameters);
  for (std::size_t i = 0; i < still.size(); ++i)
    stage.add(still[i] ? *still[i] : scans[i].surfaces());
  Slam6DResult improved = result_;
  if (!stage.relaxAgain(improved, relaxing())) {
    moving_.forget(); // so that going on comes here again
    return false;
  }
  result_ = std::move(improved);
  moving_.judge(scans, result_);
  startAnew(result_.scans.size());
  return true;
}

} // namespace pcl6d::slam6d
