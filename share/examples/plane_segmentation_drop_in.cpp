// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::SACSegmentation gets the planes of pcl6d by
// changing one class name, and all planes with hulls by one call more. Floor and two walls
// of a room.
#include "synthetic.h"

#include <pcl6d/plane_segmentation/pcl/plane_segmentation.h>

#include <pcl/segmentation/sac_segmentation.h>

#include <cstdio>

using Point = pcl::PointXYZ;

// The code that was there before: the largest plane, a x + b y + c z + d = 0.
template <typename Segmentation>
pcl::ModelCoefficients
largestPlane(Segmentation& segmentation,
             const pcl::PointCloud<Point>::Ptr& cloud,
             pcl::PointIndices& inliers)
{
  pcl::ModelCoefficients plane;
  segmentation.setInputCloud(cloud);
  segmentation.segment(inliers, plane);
  return plane;
}

int
main()
{
  // The scanner stands 2 m from each of the three faces.
  const auto room =
      makeRoomCorner<Point>(1, pcl6d::poseFromEuler({-2, -2, -2}, {0, 0, 0}));
  pcl::PointIndices inliers;

  pcl::SACSegmentation<Point> sac;
  sac.setModelType(pcl::SACMODEL_PLANE);
  sac.setMethodType(pcl::SAC_RANSAC);
  sac.setDistanceThreshold(0.02); // [m]
  largestPlane(sac, room, inliers);
  std::printf("pcl::SACSegmentation: %zu points\n", inliers.indices.size());

  pcl6d::RegionGrowingPlaneSegmentation<Point> planes; // no threshold to choose
  const auto plane = largestPlane(planes, room, inliers);
  std::printf("pcl6d: %zu points, %.2f x + %.2f y + %.2f z + %.2f = 0\n",
              inliers.indices.size(),
              plane.values[0],
              plane.values[1],
              plane.values[2],
              plane.values[3]);

  pcl6d::PlaneSegments all;
  planes.segment(all);
  for (const auto& segment : all.planes)
    std::printf("%zu points, %.1f m^2, rms %.1f mm, hull of %zu corners\n",
                segment.points.size(),
                segment.plane.area,
                1000 * segment.plane.rms,
                segment.plane.hull.size());
  const bool right = all.planes.size() == 3 && all.planes.back().plane.area > 14;
  std::printf("%s\n", right ? "three faces of the room" : "not the faces of the room");
  return right ? 0 : 1;
}
