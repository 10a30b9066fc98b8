// SPDX-License-Identifier: BSD-3-Clause
// Shows: two scans without any guess. alignByFeatures() says where the second one stood,
// and whether that can be believed; ICP6D makes it exact.
#include "synthetic.h"

#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/icp6d.h>

#include <cstdio>

using Point = pcl::PointXYZ;

int
main()
{
  const Eigen::Isometry3d truth = // far beyond what ICP could bridge
      pcl6d::poseFromEuler({0.9, -0.5, 0.1}, {0.02, -0.03, 1.2});
  const auto target = scanRoom(Eigen::Isometry3d::Identity());
  const auto source = scanRoom(truth);

  const pcl6d::CoarseEstimate coarse =
      pcl6d::alignByFeatures(pcl6d::toPoints(*target), pcl6d::toPoints(*source));
  const pcl6d::MotionSize off = pcl6d::distanceBetween(truth, coarse.T_target_source);
  std::printf("features: %s, score %.2f, second %.2f, error %.3f m %.4f rad\n",
              pcl6d::toString(coarse.status),
              coarse.score,
              coarse.second_score,
              off.translation,
              off.rotation);
  if (coarse.status != pcl6d::Status::kOk)
    return 1;

  pcl6d::ICP6D<Point, Point> icp;
  icp.setMetric(pcl6d::Metric::kGicp);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(0.3); // [m]
  pcl::PointCloud<Point> aligned;
  icp.align(aligned, coarse.T_target_source.matrix().cast<float>());
  const pcl6d::MotionSize error =
      pcl6d::distanceBetween(truth, icp.result().T_target_source);
  std::printf("ICP: %s, error %.4f m %.5f rad\n",
              pcl6d::toString(icp.result().status),
              error.translation,
              error.rotation);
  return icp.hasConverged() && error.translation < 0.02 && error.rotation < 0.005 ? 0 : 1;
}
