// SPDX-License-Identifier: BSD-3-Clause
// Shows: Slam6D on clouds in memory. Eight scans of a robot that drives through a room,
// with odometry that drifts; the registered poses are compared to the true ones.
#include "synthetic.h"

#include <pcl6d/slam6d/slam6d.h>

#include <algorithm>
#include <cstdio>
#include <vector>

int
main()
{
  const Eigen::Isometry3d step = pcl6d::poseFromEuler({0.3, 0.02, 0}, {0, 0, 0.08});
  const Eigen::Isometry3d drift =
      pcl6d::poseFromEuler({0.03, -0.02, 0.02}, {0.005, -0.005, 0.01});
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity(), odometry = truth;
  std::vector<Eigen::Isometry3d> truths;
  pcl6d::Slam6D slam;
  for (int i = 0; i < 8; ++i) {
    slam.addScan(scanRoom(truth), odometry);
    truths.push_back(truth);
    truth = truth * step;
    odometry = odometry * step * drift;
  }
  slam.optimize();

  double before = 0, after = 0; // [m] the largest errors of position
  const auto& scans = slam.result().scans;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    before = std::max(
        before, pcl6d::distanceBetween(truths[i], scans[i].initial_pose).translation);
    after = std::max(
        after, pcl6d::distanceBetween(truths[i], scans[i].T_world_scan).translation);
  }
  std::printf("%zu of %zu scans matched; off by %.3f m at most, by odometry %.3f m\n",
              slam.result().count(pcl6d::ScanState::kMatched),
              scans.size() - 1,
              after,
              before);
  return slam.result().trusted() && after < 0.05 ? 0 : 1;
}
