// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::SACSegmentation finds the right plane by
// changing one class name: the largest of a room in which no plane has an eighth of
// the points, and then the floor, by its direction.
#include "synthetic.h"

#include <pcl6d/common/random.h>
#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>

#include <cmath>
#include <cstdio>

using Point = pcl::PointXYZ;

struct Found {
  pcl::PointIndices inliers;
  pcl::ModelCoefficients plane; // a x + b y + c z + d = 0
};

// The code that was there before.
template <typename Segmentation>
Found
findPlane(Segmentation segmentation,
          const pcl::PointCloud<Point>::Ptr& cloud,
          int model)
{
  Found found;
  segmentation.setInputCloud(cloud);
  segmentation.setModelType(model);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(0.02); // [m]
  segmentation.setAxis(Eigen::Vector3f::UnitZ());
  segmentation.setEpsAngle(0.1); // [rad]; of the models that have an axis
  segmentation.segment(found.inliers, found.plane);
  std::printf("%zu points", found.inliers.indices.size());
  for (const float value : found.plane.values)
    std::printf(" %.3f", static_cast<double>(value));
  std::printf("\n");
  return found;
}

int
main()
{
  // The scanner stands 2 m from each of three faces; two in three points are clutter.
  const auto room =
      makeRoomCorner<Point>(1, pcl6d::poseFromEuler({-2, -2, -2}, {0, 0, 0}));
  const std::size_t on_faces = room->size();
  pcl6d::Random random(1);
  for (std::size_t i = 0; i < 2 * on_faces; ++i)
    room->emplace_back(static_cast<float>(random.uniform(-2, 2)),
                       static_cast<float>(random.uniform(-2, 2)),
                       static_cast<float>(random.uniform(-2, 2)));

  const auto theirs =
      findPlane(pcl::SACSegmentation<Point>(), room, pcl::SACMODEL_PLANE);
  const auto ours =
      findPlane(pcl6d::PlaneSACSegmentation<Point>(), room, pcl::SACMODEL_PLANE);
  const auto floor = findPlane(
      pcl6d::PlaneSACSegmentation<Point>(), room, pcl::SACMODEL_PERPENDICULAR_PLANE);
  const bool right = ours.inliers.indices.size() >= theirs.inliers.indices.size() &&
                     4 * ours.inliers.indices.size() > on_faces &&
                     std::abs(floor.plane.values[2]) > 0.999f &&
                     std::abs(std::abs(floor.plane.values[3]) - 2) < 0.01f;
  std::printf("%s\n", right ? "the largest plane, and the floor" : "wrong planes");
  return right ? 0 : 1;
}
