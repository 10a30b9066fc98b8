// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/input/drive_tracker.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pcl6d::app {

DriveTracker::DriveTracker(const SweepTrackerOptions& options,
                           const ScanFolder& folder,
                           ProgressBar& bar,
                           SweepPoints points)
: bar_(bar)
{
  if (points != SweepPoints::kRigid)
    moving_ = std::make_unique<TrackedDrive>(options, folder, &bar);
  if (points != SweepPoints::kMoving)
    rigid_ = std::make_unique<TrackedDrive>(options, folder, moving_ ? nullptr : &bar);
}

void
DriveTracker::track(std::size_t i, Sweep sweep)
{
  if (!moving_) {
    sweep.times.clear();
    rigid_->track(i, std::move(sweep));
    return;
  }
  if (!rigid_) {
    moving_->track(i, std::move(sweep));
    return;
  }
  Sweep rigid = sweep;
  rigid.times.clear();
  const TrackedSweep as_rigid = rigid_->track(i, std::move(rigid));
  const TrackedSweep as_moving = moving_->track(i, std::move(sweep));
  evidence_.add(as_moving, as_rigid);
  if (as_moving.status == SweepStatus::kTracked && as_moving.path.stamps.empty())
    decide(true); // all points have one time
  else if (const auto holds_motion = evidence_.holdsMotion())
    decide(*holds_motion);
}

void
DriveTracker::finish(std::size_t most_lost)
{
  if (!moving_ || !rigid_)
    return;
  const bool fails_moving = moving_->numLost() > most_lost;
  const bool fails_rigid = rigid_->numLost() > most_lost;
  decide(fails_moving == fails_rigid ? evidence_.holdsMotionInTheEnd() : fails_rigid);
}

std::size_t
DriveTracker::numLost() const
{
  if (!moving_ || !rigid_)
    return (moving_ ? moving_ : rigid_)->numLost();
  return std::min(moving_->numLost(), rigid_->numLost());
}

std::string
DriveTracker::source() const
{
  return (moving_ ? moving_ : rigid_)->source() +
         (was_corrected_ ? ", the motion within the sweeps corrected already" : "");
}

void
DriveTracker::decide(bool holds_motion)
{
  if (holds_motion) {
    rigid_.reset();
    return;
  }
  moving_.reset();
  was_corrected_ = true;
  rigid_->sayTo(&bar_);
  const std::string farther =
      evidence_.ratio() > 1
          ? " (as moving, they lie " +
                std::to_string(std::lround(100 * (evidence_.ratio() - 1))) +
                " % farther from the surfaces)"
          : "";
  bar_.say("tracking: the points have times, but the motion within the sweeps is "
           "corrected already" +
           farther + "; --deskew odometry takes the times");
}

} // namespace pcl6d::app
