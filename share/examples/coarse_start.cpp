// SPDX-License-Identifier: BSD-3-Clause
// Shows: where to start ICP. alignByFeatures() says without any guess where the second scan
// stood, searchByOverlap() mends a guess that is off by metres; both say whether that can
// be accepted. ICP6D makes it exact.
#include "synthetic.h"

#include <pcl6d/registration/feature_alignment.h>
#include <pcl6d/registration/overlap_search.h>
#include <pcl6d/registration/pcl/icp6d.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>::ConstPtr;

bool
isGood(const char* name,
       const pcl6d::CoarseEstimate& coarse,
       const Eigen::Isometry3d& truth)
{
  const pcl6d::MotionSize error = pcl6d::distanceBetween(truth, coarse.T_target_source);
  std::printf("%s: %s, score %.2f, second %.2f, error %.3f m %.4f rad\n",
              name,
              pcl6d::toString(coarse.status),
              coarse.score,
              coarse.second_score,
              error.translation,
              error.rotation);
  return coarse.status == pcl6d::Status::kOk;
}

bool
refine(const Cloud& target,
       const Cloud& source,
       const pcl6d::CoarseEstimate& coarse,
       const Eigen::Isometry3d& truth)
{
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
  return icp.hasConverged() && error.translation < 0.02 && error.rotation < 0.005;
}

int
main()
{
  const Eigen::Isometry3d truth = // far beyond what ICP could bridge
      pcl6d::poseFromEuler({0.9, -0.5, 0.1}, {0.02, -0.03, 1.2});
  const auto target = scanRoom(Eigen::Isometry3d::Identity());
  const auto source = scanRoom(truth);
  const pcl6d::Points a = pcl6d::toPoints(*target), b = pcl6d::toPoints(*source);

  const pcl6d::CoarseEstimate features = pcl6d::alignByFeatures(a, b);
  if (!isGood("features", features, truth) || !refine(target, source, features, truth))
    return 1;

  const Eigen::Isometry3d guess = truth * pcl6d::planarPose(0.8, -0.6, 0.2); // 1 m off
  const pcl6d::CoarseEstimate overlap = pcl6d::searchByOverlap(a, b, guess);
  return isGood("overlap", overlap, truth) && refine(target, source, overlap, truth)
             ? 0
             : 1;
}
