// SPDX-License-Identifier: BSD-3-Clause
// Shows: PCL's own ICP with a minimiser, a search and a filter chosen by the words that
// pcl_slam6d takes on its command line: make_parts_by_name [MINIMISER SEARCH FILTER]
#include "synthetic.h"

#include <pcl6d/filters/pcl/make_filter.h>
#include <pcl6d/registration/pcl/make.h>

#include <pcl/registration/icp.h>

#include <cstdio>
#include <exception>
#include <string>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

Cloud::Ptr
filtered(const std::string& word, const Cloud::ConstPtr& cloud)
{
  const auto filter = pcl6d::makeFilter<Point>(word, {0.05}); // [m]
  filter->setInputCloud(cloud);
  const Cloud::Ptr result(new Cloud);
  filter->filter(*result);
  return result;
}

int
main(int argc, char** argv)
try {
  const bool given = argc == 4;
  const std::string minimiser = given ? argv[1] : "helix";
  const std::string search = given ? argv[2] : "cached-tree";
  const std::string filter = given ? argv[3] : "mean";
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.02, -0.01, 0.02}, {0.002, -0.001, 0.005});

  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setTransformationEstimation(pcl6d::registration::make<Point, Point>(minimiser));
  icp.setSearchMethodTarget(pcl6d::makeKdTree<Point>(search));
  icp.setInputTarget(
      filtered(filter, makeRoomCorner<Point>(1, Eigen::Isometry3d::Identity())));
  icp.setInputSource(filtered(filter, makeRoomCorner<Point>(2, truth.inverse())));
  icp.setMaxCorrespondenceDistance(0.25); // [m]
  icp.setMaximumIterations(50);
  Cloud aligned;
  icp.align(aligned);

  const pcl6d::MotionSize error = pcl6d::distanceBetween(
      truth, Eigen::Isometry3d(icp.getFinalTransformation().cast<double>()));
  const bool right = error.translation < 0.01 && error.rotation < 0.01;
  std::printf("%s, %s, %s: error %.4f m %.4f rad, %s\n",
              minimiser.c_str(),
              search.c_str(),
              filter.c_str(),
              error.translation,
              error.rotation,
              right ? "the motion is found" : "the motion is WRONG");
  return right ? 0 : 1;
} catch (const std::exception&
             e) { // an unknown word: the message lists those that are known
  std::fprintf(stderr, "error: %s\n", e.what());
  return 1;
}
