// SPDX-License-Identifier: BSD-3-Clause
#include "matching/open_directions.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/rotation.h>

namespace pcl6d::slam6d {

bool
holdOpenDirections(const Eigen::Isometry3d& predicted, IcpResult& found)
{
  if (!found.localizability)
    return false;
  if (found.localizability->openDirections() != 1)
    return false;
  const Eigen::Translation3d centre(found.localizability->centroid);
  const Eigen::Isometry3d correction =
      centre.inverse() * (found.T_target_source * predicted.inverse()) * centre;
  const PlaneSums::Matrix& directions = found.localizability->directions;
  // Shift and turn apart: along the screw of both, a turn would carry a part of the open shift
  // across.
  Twist motion;
  motion << correction.translation(), rotationVector(correction.linear());
  Twist shares = inverted<6>(directions) * motion;
  shares(0) = 0; // ascending: the open motion is the first
  motion = directions * shares;
  Eigen::Isometry3d kept(rotationFromVector(motion.tail<3>()));
  kept.pretranslate(motion.head<3>());
  found.T_target_source = centre * kept * centre.inverse() * predicted;
  found.status = Status::kRankDeficient;
  found.covariance.reset();
  return true;
}

} // namespace pcl6d::slam6d
