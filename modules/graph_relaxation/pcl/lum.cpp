// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/link_equation.h"

#include <pcl6d/graph_relaxation/pcl/lum.h>

namespace pcl6d {

PCL6D_DEFINE_INSTANCES(LUM)

Eigen::Matrix<float, 6, 1>
lumPose(const Eigen::Isometry3d& pose)
{
  const EulerAngles angles = eulerFromRotation(pose.linear());
  Twist vector;
  vector << pose.translation(), angles.roll, angles.pitch, angles.yaw;
  return vector.cast<float>();
}

void
lumEdge(const LinkReport& link,
        Eigen::Matrix<float, 6, 6>& information,
        Eigen::Matrix<float, 6, 1>& moment)
{
  const Eigen::Matrix<double, 6, 6> S =
      graph_relaxation::originShift<6>(Eigen::Vector3d::Zero(), link.centre);
  const Eigen::Matrix<double, 6, 6> SK = S.transpose() * link.information;
  // PCL's class has the turns in the order x, z, y.
  const Eigen::PermutationMatrix<6> order(
      (Eigen::Matrix<int, 6, 1>() << 0, 1, 2, 3, 5, 4).finished());
  information = (order * (SK * S) * order).cast<float>();
  moment = (order * (SK * link.correction)).cast<float>();
}

} // namespace pcl6d
