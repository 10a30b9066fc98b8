// SPDX-License-Identifier: BSD-3-Clause
// Shows: PCL's pipeline by hand, each part of it ours. Correspondences, rejectors and the
// estimation of the motion are written as PCL's are; here they also stand in PCL's own ICP, and
// at last one motion is found from several pairs of clouds, and a first guess without any.
#include "synthetic.h"

#include <pcl6d/registration/pcl/correspondence_estimation.h>
#include <pcl6d/registration/pcl/correspondence_rejector_one_to_one.h>
#include <pcl6d/registration/pcl/correspondence_rejector_overlap.h>
#include <pcl6d/registration/pcl/correspondence_rejector_surface_normal.h>
#include <pcl6d/registration/pcl/correspondence_rejector_trimmed.h>
#include <pcl6d/registration/pcl/feature_alignment.h>
#include <pcl6d/registration/pcl/joint_icp6d.h>
#include <pcl6d/registration/pcl/transformation_estimation_plane_linear.h>

#include <pcl/common/transforms.h>
#include <pcl/features/normal_3d.h>
#include <pcl/registration/icp.h>

#include <cstdio>

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

const Eigen::Isometry3d kTruth =
    pcl6d::poseFromEuler({0.05, -0.03, 0.04}, {0.01, -0.01, 0.02}); // [m], [rad]

Cloud::Ptr
withNormals(const Cloud::Ptr& cloud)
{
  pcl::NormalEstimation<Point, Point> estimation;
  estimation.setSearchMethod(pcl::make_shared<pcl6d::KdTree<Point>>());
  estimation.setInputCloud(cloud);
  estimation.setKSearch(20);
  estimation.setViewPoint(2, 2, 2); // where the scanner may have stood
  Cloud normals;
  estimation.compute(normals);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getNormalVector3fMap() = normals[i].getNormalVector3fMap();
  return cloud;
}

bool
isGood(const char* name,
       const Eigen::Matrix4f& found,
       const Eigen::Isometry3d& truth,
       double tolerance)
{
  Eigen::Isometry3d motion;
  motion.matrix() = found.cast<double>();
  const pcl6d::MotionSize error = pcl6d::distanceBetween(truth, motion);
  std::printf("%-14s error %.1f mm %.2f mrad\n",
              name,
              1e3 * error.translation,
              1e3 * error.rotation);
  return error.translation < tolerance;
}

/** One loop of ICP, each of its parts by hand. */
Eigen::Matrix4f
byHand(const Cloud::Ptr& source, const Cloud::Ptr& target)
{
  pcl6d::CorrespondenceEstimation<Point, Point> estimation;
  pcl6d::CorrespondenceRejectorOneToOne one_to_one;
  pcl6d::CorrespondenceRejectorSurfaceNormal same_side;
  same_side.setThreshold(0.9); // cosine
  same_side.setTargetNormals<Point, Point>(target);
  pcl6d::CorrespondenceRejectorOverlap in_overlap;
  in_overlap.setInputTarget<Point>(target);
  const pcl6d::TransformationEstimationPlaneLinear<Point, Point> minimiser;

  estimation.setInputTarget(target);
  Eigen::Matrix4f T = Eigen::Matrix4f::Identity();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto moved = pcl::make_shared<Cloud>();
    pcl::transformPointCloudWithNormals(*source, *moved, T);
    pcl::Correspondences pairs;
    estimation.setInputSource(moved);
    estimation.determineCorrespondences(pairs, 0.3); // [m]
    same_side.setInputNormals<Point, Point>(moved);
    one_to_one.getRemainingCorrespondences(pairs, pairs);
    same_side.getRemainingCorrespondences(pairs, pairs);
    in_overlap.getRemainingCorrespondences(pairs, pairs);
    Eigen::Matrix4f step;
    minimiser.estimateRigidTransformation(*moved, *target, pairs, step);
    T = step * T;
  }
  return T;
}

/** PCL's own ICP with parts of ours. */
Eigen::Matrix4f
inPclsIcp(const Cloud::Ptr& source, const Cloud::Ptr& target)
{
  const auto trimmed = pcl::make_shared<pcl6d::CorrespondenceRejectorTrimmed>();
  trimmed->setOverlapRatio(0.9f);
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setSearchMethodTarget(pcl::make_shared<pcl6d::KdTree<Point>>());
  icp.setCorrespondenceEstimation(
      pcl::make_shared<pcl6d::CorrespondenceEstimation<Point, Point>>());
  icp.addCorrespondenceRejector(trimmed);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaximumIterations(100);
  Cloud aligned;
  icp.align(aligned);
  return icp.getFinalTransformation();
}

/** One motion of two pairs of clouds. */
Eigen::Matrix4f
jointly(const Cloud::Ptr& source, const Cloud::Ptr& target)
{
  pcl6d::JointICP6D<Point, Point> icp; // for pcl::JointIterativeClosestPoint
  icp.setMetric(pcl6d::Metric::kPlane);
  icp.addInputSource(source);
  icp.addInputTarget(target);
  icp.addInputSource(withNormals(makeRoomCorner<Point>(4, kTruth.inverse())));
  icp.addInputTarget(
      withNormals(makeRoomCorner<Point>(3, Eigen::Isometry3d::Identity())));
  icp.setMaxCorrespondenceDistance(0.3);
  Cloud aligned;
  icp.align(aligned);
  std::printf("               PCL's state of convergence: %d\n",
              static_cast<int>(icp.getConvergeCriteria()->getConvergenceState()));
  return icp.hasConverged() ? icp.getFinalTransformation()
                            : Eigen::Matrix4f::Identity();
}

/** A first guess without any. */
bool
isPlaced()
{
  const Eigen::Isometry3d far =
      pcl6d::poseFromEuler({0.9, -0.5, 0.1}, {0.02, -0.03, 1.2});
  pcl6d::FeatureAlignment<pcl::PointXYZ, pcl::PointXYZ> coarse;
  coarse.setInputTarget(scanRoom(Eigen::Isometry3d::Identity()));
  coarse.setInputSource(scanRoom(far));
  pcl::PointCloud<pcl::PointXYZ> aligned;
  coarse.align(aligned);
  return coarse.hasConverged() &&
         isGood("without guess", coarse.getFinalTransformation(), far, 0.2);
}

int
main()
{
  const auto target =
      withNormals(makeRoomCorner<Point>(1, Eigen::Isometry3d::Identity()));
  const auto source = withNormals(makeRoomCorner<Point>(2, kTruth.inverse()));
  const bool right = isGood("by hand", byHand(source, target), kTruth, 0.01) &
                     isGood("in PCL's ICP", inPclsIcp(source, target), kTruth, 0.03) &
                     isGood("joint", jointly(source, target), kTruth, 0.01) &
                     isPlaced();
  return right ? 0 : 1;
}
