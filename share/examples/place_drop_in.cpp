// SPDX-License-Identifier: BSD-3-Clause
// Shows: two scans without any guess. pcl6d::GlobalRegistration where code says
// pcl::SampleConsensusPrerejective or pcl::registration::FPCSInitialAlignment; and the parts
// for a pipeline of one's own: radii from the cloud, the few right ones of many pairs of
// features, and which way is up.
#include "synthetic.h"

#include <pcl6d/global_registration/pcl/correspondence_rejector_compatibility.h>
#include <pcl6d/global_registration/pcl/feature_scale_estimation.h>
#include <pcl6d/global_registration/pcl/global_registration.h>
#include <pcl6d/global_registration/pcl/vertical_estimation.h>

#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/transformation_estimation_svd.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Feature = pcl::FPFHSignature33;

bool
isNear(const char* name,
       const Eigen::Matrix4f& found,
       const Eigen::Isometry3d& truth,
       double within) // [m]
{
  const pcl6d::MotionSize error =
      pcl6d::distanceBetween(truth, Eigen::Isometry3d(found.cast<double>()));
  std::printf("%s: error %.4f m %.5f rad\n", name, error.translation, error.rotation);
  return error.translation < within;
}

// The whole of it in one class; its hasConverged() may be accepted.
bool
placeInOne(const Cloud::ConstPtr& source,
           const Cloud::ConstPtr& target,
           const Eigen::Isometry3d& truth)
{
  pcl6d::GlobalRegistration<Point, Point> placing;
  placing.setInputSource(source); // whole scans: it reduces them itself
  placing.setInputTarget(target);
  Cloud aligned;
  placing.align(aligned);
  std::printf("place: %s %s, %zu candidates\n",
              toString(placing.answer()),
              placing.reason().c_str(),
              placing.candidates().size());
  return placing.hasConverged() &&
         isNear("GlobalRegistration", placing.getFinalTransformation(), truth, 0.02);
}

// What PCL's classes for features want: points, and FPFH of radii that fit them.
struct Described {
  Cloud::Ptr points{new Cloud};
  pcl::PointCloud<Feature>::Ptr features{new pcl::PointCloud<Feature>};

  Described(const Cloud::ConstPtr& scan, const pcl6d::FeatureScale& scale)
  {
    const auto leaf = static_cast<float>(scale.voxel);
    pcl::VoxelGrid<Point> grid;
    grid.setLeafSize(leaf, leaf, leaf);
    grid.setInputCloud(scan);
    grid.filter(*points);
    pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
    pcl::NormalEstimation<Point, pcl::Normal> estimation;
    estimation.setInputCloud(points);
    estimation.setRadiusSearch(scale.normal_radius);
    estimation.compute(*normals);
    pcl::FPFHEstimation<Point, pcl::Normal> fpfh;
    fpfh.setInputCloud(points);
    fpfh.setInputNormals(normals);
    fpfh.setRadiusSearch(scale.feature_radius);
    fpfh.compute(*features);
  }
};

// The same by features, part for part, with PCL's classes.
bool
placeByFeatures(const Cloud::ConstPtr& source,
                const Cloud::ConstPtr& target,
                const Eigen::Isometry3d& truth)
{
  pcl6d::FeatureScaleEstimation<Point> scales;
  scales.setInputCloud(target);
  const pcl6d::FeatureScale scale = scales.compute().at(0);
  std::printf("scale: voxel %.3f m, features %.3f m (%s)\n",
              scale.voxel,
              scale.feature_radius,
              scale.why.c_str());
  const Described from(source, scale), to(target, scale);
  pcl::registration::CorrespondenceEstimation<Feature, Feature> matching;
  matching.setInputSource(from.features);
  matching.setInputTarget(to.features);
  pcl::CorrespondencesPtr pairs(new pcl::Correspondences);
  matching.determineReciprocalCorrespondences(*pairs);

  pcl6d::CorrespondenceRejectorCompatibility rejector; // its noise: from the clouds
  rejector.setInputSource<Point>(from.points);
  rejector.setInputTarget<Point>(to.points);
  pcl::Correspondences right;
  rejector.getRemainingCorrespondences(*pairs, right);
  std::printf("pairs: %zu, of these compatible: %zu\n", pairs->size(), right.size());
  pcl::registration::TransformationEstimationSVD<Point, Point> estimation;
  Eigen::Matrix4f T;
  estimation.estimateRigidTransformation(*from.points, *to.points, right, T);
  return isNear("features", T, truth, 0.3);
}

bool
standUpright(const Cloud::ConstPtr& scan, const Eigen::Isometry3d& T_room_scan)
{
  pcl6d::VerticalEstimation<Point> vertical;
  vertical.setInputCloud(scan);
  const pcl6d::VerticalEstimate found = vertical.compute();
  const Eigen::Vector3d up =
      T_room_scan.linear().transpose() * Eigen::Vector3d::UnitZ();
  std::printf(
      "up: %.3f %.3f %.3f, %.0f %% of the surfaces are level or upright by it\n",
      found.up.x(),
      found.up.y(),
      found.up.z(),
      100 * found.share);
  return found.up.dot(up) > 0.9999;
}

int
main()
{
  const Eigen::Isometry3d first = pcl6d::poseFromEuler({0, 0, 0}, {0.02, 0.01, 0});
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.9, -0.5, 0.1}, {0.02, -0.03, 1.2}); // [m], [rad]
  const Cloud::Ptr target = scanRoom(first), source = scanRoom(first * truth);
  const bool is_right = placeInOne(source, target, truth) &&
                        placeByFeatures(source, target, truth) &&
                        standUpright(source, first * truth);
  std::puts(is_right ? "the place is found" : "a place is WRONG");
  return is_right ? 0 : 1;
}
