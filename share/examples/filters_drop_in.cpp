// SPDX-License-Identifier: BSD-3-Clause
// Shows: what a scan passes before it is matched, each step a filter as PCL knows them.
#include "synthetic.h"

#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/filters/pcl/range_gate.h>
#include <pcl6d/filters/pcl/scan_line_median.h>
#include <pcl6d/filters/pcl/scan_line_reduction.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

int
main()
{
  const Cloud::Ptr scan = scanRoom(Eigen::Isometry3d::Identity());
  const std::size_t mixed = 20 * kTurns + 30; // a mixed pixel: far behind its wall
  (*scan)[mixed].getVector3fMap() *= 3;

  Cloud::Ptr filtered(new Cloud), lines(new Cloud), gated(new Cloud),
      reduced(new Cloud);
  pcl6d::ScanLineMedian<Point> median; // moves it to the wall; keeps all points
  median.setLineLength(kTurns);
  median.setInputCloud(scan);
  median.filter(*filtered);

  pcl6d::ScanLineReduction<Point> line_reduction;
  line_reduction.options().max_distance = 0.2; // [m]
  line_reduction.setLineLength(kTurns);
  line_reduction.setInputCloud(filtered);
  line_reduction.filter(*lines);

  pcl6d::RangeGate<Point> gate;
  gate.setLimits(0.5, 6); // [m] from the scanner
  gate.setInputCloud(lines);
  gate.filter(*gated);

  pcl6d::OctreeReduction<Point> octree;
  octree.options().voxel = 0.25;                             // [m]
  octree.options().method = pcl6d::ReductionMethod::kRandom; // measured points
  octree.setInputCloud(gated);
  octree.filter(*reduced);

  std::printf("%zu points, %zu along lines, %zu within range, %zu in voxels\n",
              scan->size(),
              lines->size(),
              gated->size(),
              reduced->size());
  const double was = (*scan)[mixed].getVector3fMap().norm();
  const double is = (*filtered)[mixed].getVector3fMap().norm();
  std::printf("the mixed pixel at %.2f m went to %.2f m\n", was, is);
  const bool fewer = lines->size() < scan->size() && gated->size() < lines->size() &&
                     reduced->size() < gated->size();
  return fewer && !reduced->empty() && is < 0.5 * was ? 0 : 1;
}
