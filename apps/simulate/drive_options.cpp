// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/drive_options.h"

namespace pcl6d::app {

void
describeDrive(CommandLine& line, DriveWords& words)
{
  line.group("Drive").add_options() //
      ("motion",
       valueOf(words.motion),
       "stop|continuous: stop for each scan, or drive on meanwhile; then points have "
       "the field t, and times.txt has the stamps") //
      ("speed",
       valueOf(words.speed),
       "[m/s] or auto: 1, slower if a scan takes longer than the way to the next") //
      ("odometry",
       valueOf(words.odometry),
       "wheel|visual-inertial|exact: planar with drift, six degrees of freedom with "
       "little drift, the truth");
}

void
applyDrive(const DriveWords& words, SimulationOptions& options)
{
  if (!words.speed.is_auto)
    options.speed = words.speed.value;
  checkOptions([&] {
    options.motion = scanMotionFromName(words.motion);
    options.odometry_kind = odometryKindFromName(words.odometry);
  });
}

} // namespace pcl6d::app
