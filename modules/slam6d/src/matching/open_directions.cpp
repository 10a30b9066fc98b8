// SPDX-License-Identifier: BSD-3-Clause
#include "matching/open_directions.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/registration/twist.h>

namespace pcl6d::slam6d {

namespace {
/** A single plane leaves three motions open. */
constexpr int kMostOpen = 3;
} // namespace

bool
holdOpenDirections(const Eigen::Isometry3d& predicted, IcpResult& found)
{
  if (!found.localizability)
    return false;
  const int open = found.localizability->openDirections();
  if (open < 1 || open > kMostOpen)
    return false;
  const Eigen::Translation3d centre(found.localizability->centroid);
  const Eigen::Isometry3d correction =
      centre.inverse() * (found.T_target_source * predicted.inverse()) * centre;
  const PlaneSums::Matrix& directions = found.localizability->directions;
  Twist shares = inverted<6>(directions) * twistFromMotion(correction);
  shares.head(open).setZero(); // ascending: the open motions are the first
  found.T_target_source =
      centre * motionFromTwist(directions * shares) * centre.inverse() * predicted;
  return true;
}

} // namespace pcl6d::slam6d
