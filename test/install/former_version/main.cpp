// SPDX-License-Identifier: BSD-3-Clause
// Paths and names of version 0.1 before the rooms moved.
#include <pcl6d/benchmarking/segment_map.h>
#include <pcl6d/images/image_files.h>
#include <pcl6d/io/run_summary.h>
#include <pcl6d/registration/icp6d.h>
#include <pcl6d/scanner/motion_correction.h>
#include <pcl6d/scanner/ray_caster.h>
#include <pcl6d/scanner/scene_builder.h>

#include <cmath>
#include <iostream>

int
main()
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < 400; ++i) {
    const float x = 0.1f * static_cast<float>(i % 20);
    const float y = 0.1f * static_cast<float>(i / 20);
    cloud->emplace_back(x, y, std::sin(2 * x) * std::cos(3 * y));
  }
  pcl6d::ICP6D<pcl::PointXYZ, pcl::PointXYZ> icp;
  icp.setInputSource(cloud);
  icp.setInputTarget(cloud);
  pcl::PointCloud<pcl::PointXYZ> aligned;
  icp.align(aligned);

  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1), {});
  const pcl6d::RayCaster caster(scene);
  int hits = 0;
  for (int axis = 0; axis < 3; ++axis)
    hits += caster.cast({Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(axis)}) ? 1 : 0;

  const pcl6d::RunSummary summary;
  std::cout << "ICP " << pcl6d::toString(icp.result().status) << ", " << hits
            << " rays, RunSummary with " << summary.scans.size() << " scans\n";
}
