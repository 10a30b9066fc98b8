// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for PCL's ICP gets PCL6D by changing one class name,
// and a PCL6D minimiser works inside PCL's own ICP.
#include <pcl6d/common/pose.h>
#include <pcl6d/registration/pcl/icp6d.h>
#include <pcl6d/registration/pcl/transformation_estimation_quaternion.h>

#include <pcl/common/transforms.h>
#include <pcl/registration/icp.h>

#include <cstdio>
#include <random>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

// The code that was there before: it speaks of PCL only.
Eigen::Isometry3d
registerPair(pcl::Registration<Point, Point>& registration,
             const Cloud::ConstPtr& source,
             const Cloud::ConstPtr& target)
{
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setMaximumIterations(100);
  registration.setMaxCorrespondenceDistance(0.5); // [m]
  registration.setTransformationEpsilon(1e-10);   // [m^2]
  Cloud aligned;
  registration.align(aligned);
  return Eigen::Isometry3d(registration.getFinalTransformation().cast<double>());
}

// Floor and two walls of a room, 4 m x 4 m x 4 m, with the corner at the origin.
Cloud::Ptr
makeRoomCorner()
{
  std::mt19937 random(42);
  const auto draw = [&] { return static_cast<float>(4.0 * random() / random.max()); };
  Cloud::Ptr corner(new Cloud);
  for (int i = 0; i < 3000; ++i) {
    Point p{draw(), draw(), draw()}; // braces: drawn in this order
    p.data[i % 3] = 0;               // on the wall x = 0, the wall y = 0 or the floor
    corner->push_back(p);
  }
  return corner;
}

// Prints the motion found and how far it is from the true one; false if it is wrong.
bool
report(const char* method,
       const Eigen::Isometry3d& found,
       const Eigen::Isometry3d& truth,
       const char* outcome)
{
  constexpr double kTolerance = 1e-4; // [m] and [rad]; the clouds match up to rounding
  const pcl6d::MotionSize motion =
      pcl6d::distanceBetween(Eigen::Isometry3d::Identity(), found);
  const pcl6d::MotionSize error = pcl6d::distanceBetween(truth, found);
  std::printf("%-31s %-14s %.4f m %.4f rad, error %.0e m %.0e rad\n",
              method,
              outcome,
              motion.translation,
              motion.rotation,
              error.translation,
              error.rotation);
  return error.translation < kTolerance && error.rotation < kTolerance;
}

int
main()
{
  const Cloud::Ptr target = makeRoomCorner();
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.10, -0.05, 0.08}, {0.02, -0.01, 0.05}); // [m], [rad]
  Cloud::Ptr source(new Cloud);
  pcl::transformPointCloud(*target, *source, truth.inverse().matrix());

  report("true motion", truth, truth, "");

  pcl::IterativeClosestPoint<Point, Point> pcl_icp;
  Eigen::Isometry3d found = registerPair(pcl_icp, source, target);
  bool right = report("pcl::IterativeClosestPoint",
                      found,
                      truth,
                      pcl_icp.hasConverged() ? "converged" : "not converged");

  // One class name changed. The result also says why it may not have converged.
  pcl6d::ICP6D<Point, Point> icp6d;
  found = registerPair(icp6d, source, target);
  right &=
      report("pcl6d::ICP6D", found, truth, pcl6d::toString(icp6d.result().status)) &&
      icp6d.hasConverged();

  // Only the minimiser is ours.
  pcl_icp.setTransformationEstimation(
      pcl::make_shared<pcl6d::TransformationEstimationQuaternion<Point, Point>>());
  found = registerPair(pcl_icp, source, target);
  right &= report("PCL's ICP with our quaternions",
                  found,
                  truth,
                  pcl_icp.hasConverged() ? "converged" : "not converged");

  std::puts(right ? "all three found the true motion" : "a motion is WRONG");
  return right ? 0 : 1;
}
