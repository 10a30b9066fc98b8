// SPDX-License-Identifier: BSD-3-Clause
// Shows: points to points, points to planes and planes to planes (GICP) with one class
// each, on two noisy samples of a corner, with one of PCL's rejectors. No normals are
// given: they are estimated.
#include "synthetic.h"

#include <pcl6d/registration/pcl/icp6d.h>

#include <pcl/registration/correspondence_rejection_median_distance.h>

#include <cstdio>

using Point = pcl::PointXYZ;

int
main()
{
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.10, -0.05, 0.08}, {0.02, -0.01, 0.05}); // [m], [rad]
  const auto target = makeRoomCorner<Point>(1, Eigen::Isometry3d::Identity());
  const auto source = makeRoomCorner<Point>(2, truth.inverse());

  pcl6d::ICP6D<Point, Point> to_points, to_planes;
  to_planes.setMetric(pcl6d::Metric::kPlane);
  pcl6d::GICP6D<Point, Point> planes; // for pcl::GeneralizedIterativeClosestPoint
  planes.setCorrespondenceRandomness(20);

  bool right = true;
  for (pcl6d::ICP6D<Point, Point>* icp :
       {&to_points, &to_planes, static_cast<pcl6d::ICP6D<Point, Point>*>(&planes)}) {
    const auto rejector =
        pcl::make_shared<pcl::registration::CorrespondenceRejectorMedianDistance>();
    rejector->setMedianFactor(9);
    icp->addCorrespondenceRejector(rejector);
    icp->setInputSource(source);
    icp->setInputTarget(target);
    icp->setMaxCorrespondenceDistance(0.25); // [m]
    pcl::PointCloud<Point> aligned;
    icp->align(aligned);

    const pcl6d::IcpResult& result = icp->result();
    const pcl6d::MotionSize error =
        pcl6d::distanceBetween(truth, result.T_target_source);
    std::printf("%-7s %s after %2d iterations, error %.1f mm %.1f mrad\n",
                icp == &to_points   ? "points"
                : icp == &to_planes ? "plane"
                                    : "planes",
                pcl6d::toString(result.status),
                result.iterations,
                1e3 * error.translation,
                1e3 * error.rotation);
    right &= icp->hasConverged() && error.translation < 0.02 && error.rotation < 0.01;
  }
  return right ? 0 : 1;
}
