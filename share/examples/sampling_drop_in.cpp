// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::UniformSampling, pcl::ApproximateVoxelGrid,
// pcl::MedianFilter and pcl::NormalEstimation gets ours by changing the namespace.
#include "synthetic.h"

#include <pcl6d/filters/pcl/approximate_voxel_grid.h>
#include <pcl6d/filters/pcl/median_filter.h>
#include <pcl6d/filters/pcl/normal_estimation.h>
#include <pcl6d/filters/pcl/uniform_sampling.h>

#include <pcl/filters/approximate_voxel_grid.h>
#include <pcl/filters/median_filter.h>
#include <pcl/filters/uniform_sampling.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;

struct Counts {
  std::size_t leaves, samples;
  float spike; ///< [m] a depth of 9 m after the median filter, where 2 m are right
  double
      off_axis; ///< of the worst of most normals: all surfaces of the room face an axis
};

// The code that was there before.
template <typename VoxelGrid, typename Sampling, typename Median, typename Estimation>
Counts
processed(const Cloud::Ptr& scan, const Cloud::Ptr& image)
{
  Counts counts{};
  Cloud output;
  VoxelGrid grid;
  grid.setLeafSize(0.2f, 0.2f, 0.2f);
  grid.setInputCloud(scan);
  grid.filter(output);
  counts.leaves = output.size();

  const Cloud::Ptr samples(new Cloud);
  Sampling sampling;
  sampling.setRadiusSearch(0.2);
  sampling.setInputCloud(scan);
  sampling.filter(*samples);
  counts.samples = samples->size();

  Median median;
  median.setWindowSize(3);
  median.setInputCloud(image);
  median.filter(output);
  counts.spike = output(4, 4).z;

  Normals normals;
  Estimation estimation;
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<Point>>());
  estimation.setSearchSurface(scan);
  estimation.setInputCloud(samples);
  estimation.setKSearch(12);
  estimation.compute(normals);
  std::vector<double> off;
  for (const auto& n : normals)
    off.push_back(1 - n.getNormalVector3fMap().cwiseAbs().maxCoeff());
  std::sort(off.begin(), off.end());
  counts.off_axis = off[off.size() / 2];
  return counts;
}

int
main()
{
  const Cloud::Ptr scan = scanRoom(Eigen::Isometry3d::Identity());
  const Cloud::Ptr image(new Cloud(9, 9, Point(0, 0, 2)));
  (*image)(4, 4).z = 9;
  const Counts of_pcl =
      processed<pcl::ApproximateVoxelGrid<Point>,
                pcl::UniformSampling<Point>,
                pcl::MedianFilter<Point>,
                pcl::NormalEstimation<Point, pcl::Normal>>(scan, image);
  const Counts ours =
      processed<pcl6d::ApproximateVoxelGrid<Point>,
                pcl6d::UniformSampling<Point>,
                pcl6d::MedianFilter<Point>,
                pcl6d::NormalEstimation<Point, pcl::Normal>>(scan, image);
  for (const auto& [name, c] : {std::pair("PCL:  ", of_pcl), {"ours: ", ours}})
    std::printf(
        "%s %zu points of leaves, %zu samples, depth %.1f m, normals %.1e off\n",
        name,
        c.leaves,
        c.samples,
        c.spike,
        c.off_axis);
  // Each sample is in a leaf of its own, so there are as many as leaves.
  const bool is_right = ours.leaves == ours.samples && ours.samples == of_pcl.samples &&
                        ours.spike == 2 && ours.off_axis < 1e-4;
  return is_right ? 0 : 1;
}
