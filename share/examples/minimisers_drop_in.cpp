// SPDX-License-Identifier: BSD-3-Clause
// Shows: each of our minimisers inside PCL's own ICP, as setTransformationEstimation()
// takes them. Those of planes need normals in the target.
#include "synthetic.h"

#include <pcl6d/registration/pcl/transformation_estimation_dual_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_euler.h>
#include <pcl6d/registration/pcl/transformation_estimation_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_orthonormal.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_helix.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion_linear.h>
#include <pcl6d/registration/pcl/transformation_estimation_scale_quaternion.h>
#include <pcl6d/registration/pcl/transformation_estimation_small_angle.h>
#include <pcl6d/registration/pcl/transformation_estimation_svd.h>

#include <pcl/registration/icp.h>

#include <cstdio>
#include <utility>
#include <vector>

using Point = pcl::PointNormal;
using Icp = pcl::IterativeClosestPoint<Point, Point>;
using Cloud = pcl::PointCloud<Point>::ConstPtr;
using Minimiser = Icp::TransformationEstimationPtr;

std::vector<std::pair<const char*, Minimiser>>
allMinimisers()
{
  return {
      {"svd", Minimiser(new pcl6d::TransformationEstimationSVD<Point, Point>)},
      {"quaternion",
       Minimiser(new pcl6d::TransformationEstimationQuaternion<Point, Point>)},
      {"orthonormal",
       Minimiser(new pcl6d::TransformationEstimationOrthonormal<Point, Point>)},
      {"dual-quaternion",
       Minimiser(new pcl6d::TransformationEstimationDualQuaternion<Point, Point>)},
      {"scale-quaternion",
       Minimiser(new pcl6d::TransformationEstimationScaleQuaternion<Point, Point>)},
      {"helix", Minimiser(new pcl6d::TransformationEstimationHelix<Point, Point>)},
      {"small-angle",
       Minimiser(new pcl6d::TransformationEstimationSmallAngle<Point, Point>)},
      {"euler", Minimiser(new pcl6d::TransformationEstimationEuler<Point, Point>)},
      {"quaternion-linear",
       Minimiser(new pcl6d::TransformationEstimationQuaternionLinear<Point, Point>)},
      {"plane-linear",
       Minimiser(new pcl6d::TransformationEstimationPlaneLinear<Point, Point>)},
      {"plane-helix",
       Minimiser(new pcl6d::TransformationEstimationPlaneHelix<Point, Point>)}};
}

pcl6d::MotionSize
errorOf(const Minimiser& minimiser,
        const Cloud& source,
        const Cloud& target,
        const Eigen::Isometry3d& truth)
{
  Icp icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaxCorrespondenceDistance(0.25); // [m]
  icp.setMaximumIterations(50);
  icp.setTransformationEstimation(minimiser);
  pcl::PointCloud<Point> aligned;
  icp.align(aligned);
  return pcl6d::distanceBetween(
      truth, Eigen::Isometry3d(icp.getFinalTransformation().cast<double>()));
}

int
main()
{
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.02, -0.01, 0.02}, {0.002, -0.001, 0.005});
  const auto target = makeRoomCorner<Point>(1, Eigen::Isometry3d::Identity());
  const auto source = makeRoomCorner<Point>(1, truth.inverse());
  for (std::size_t i = 0; i < target->size(); ++i) // the walls stand on the axes
    (*target)[i].getNormalVector3fMap() = Eigen::Vector3f::Unit(i % 3);

  bool right = true;
  for (const auto& [name, minimiser] : allMinimisers()) {
    const pcl6d::MotionSize error = errorOf(minimiser, source, target, truth);
    std::printf(
        "%-17s error %.0e m %.0e rad\n", name, error.translation, error.rotation);
    right &= error.translation < 1e-3 && error.rotation < 1e-3;
  }
  std::puts(right ? "all minimisers found the motion" : "a motion is WRONG");
  return right ? 0 : 1;
}
