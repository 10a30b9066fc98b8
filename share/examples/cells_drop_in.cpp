// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::VoxelGrid and pcl::NormalDistributionsTransform, as
// PCL's tutorial of the latter has it, gets OctreeReduction and NDT6D by changing two names.
#include "synthetic.h"

#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/registration/pcl/ndt6d.h>

#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/ndt.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

// The code that was there before.
template <typename VoxelGrid, typename Ndt>
Eigen::Isometry3d
registered(const Cloud::ConstPtr& source, const Cloud::ConstPtr& target)
{
  const Cloud::Ptr thin(new Cloud);
  VoxelGrid grid;
  grid.setLeafSize(0.1f, 0.1f, 0.1f);
  grid.setInputCloud(source);
  grid.filter(*thin);
  Ndt ndt;
  ndt.setTransformationEpsilon(0.001);
  ndt.setStepSize(0.1);
  ndt.setResolution(1.0);
  ndt.setMaximumIterations(35);
  ndt.setInputSource(thin);
  ndt.setInputTarget(target);
  Cloud aligned;
  ndt.align(aligned);
  return Eigen::Isometry3d(ndt.getFinalTransformation().template cast<double>());
}

int
main()
{
  const Eigen::Isometry3d moved =
      pcl6d::poseFromEuler({0.25, -0.15, 0}, {0, 0, 0.06}); // T_target_source
  const Cloud::Ptr target = scanRoom(Eigen::Isometry3d::Identity());
  const Cloud::Ptr source = scanRoom(moved);
  const auto error = [&](const Eigen::Isometry3d& found) {
    return pcl6d::distanceBetween(found, moved).translation;
  };
  const double of_pcl = error(
      registered<pcl::VoxelGrid<Point>,
                 pcl::NormalDistributionsTransform<Point, Point>>(source, target));
  const double ours =
      error(registered<pcl6d::OctreeReduction<Point>, pcl6d::NDT6D<Point, Point>>(
          source, target));
  std::printf("%.4f m off with pcl::NormalDistributionsTransform, %.4f m with "
              "pcl6d::NDT6D\n",
              of_pcl,
              ours);
  return ours < 0.03 ? 0 : 1;
}
