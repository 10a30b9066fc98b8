// SPDX-License-Identifier: BSD-3-Clause
// What moved while scans were taken, as a run leaves it out.
#include "slam_run.h"

#include <utility>

namespace pcl6d::slam6d {

bool
SlamRun::leaveOutMoving()
{
  const auto whole = verification_.surfaces(scans_.reduced());
  if (!moving_.judge(verification_.scans(), whole, result_))
    return true;
  const IcpModel::Options with_normals = matcher_->matcher().modelOptions(true);
  verification_.leaveOut(moving_.still(with_normals), scans_.reduced());
  if (!moving_.isNoticeable())
    return true;
  GraphStage stage = makeGraphStage(sharing, result_.parameters);
  for (const VerifiedScan& scan : verification_.scans())
    stage.add(scan.surfaces());
  Slam6DResult improved = result_;
  if (!stage.relaxAgain(improved, relaxing())) {
    moving_.forget(); // so that going on comes here again
    return false;
  }
  result_ = std::move(improved);
  if (!moving_.judge(verification_.scans(), whole, result_))
    return true;
  verification_.leaveOut(moving_.still(with_normals), scans_.reduced());
  startAnew(result_.scans.size());
  return true;
}

} // namespace pcl6d::slam6d
