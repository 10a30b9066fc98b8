// SPDX-License-Identifier: BSD-3-Clause
// What the Python package costs: the registrations of pair_time.py, by the library alone.
// usage: pair_time TARGET SOURCE icp|gicp REPEATS
// Prints least wall time [s], least processor time [s], iterations, x of the pose [m], peak memory
// before and after the calls [kB].
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/registration/icp_model.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <sys/resource.h>

namespace {
pcl6d::IcpResult
registerPair(const pcl6d::Points& target_points,
             const pcl6d::Points& source_points,
             bool gicp)
{
  pcl6d::IcpOptions options;
  options.metric = gicp ? pcl6d::Metric::kGicp : pcl6d::Metric::kPoint;
  options.max_distance = 0.5;
  pcl6d::IcpModel::Options model;
  model.normals = gicp;
  const pcl6d::IcpModel target(target_points, model);
  const pcl6d::Points points = source_points; // as the package copies the arrays
  pcl6d::Normals normals;
  if (gicp)
    normals = pcl6d::estimateNormals(points, pcl6d::PointTree(points));
  return icp({target.part()},
             {&points, gicp ? &normals : nullptr},
             Eigen::Isometry3d::Identity(),
             options);
}

long
peakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}
} // namespace

int
main(int argc, char** argv)
{
  if (argc != 5)
    return 2;
  const pcl6d::Points target = pcl6d::readScan(argv[1]).points;
  const pcl6d::Points source = pcl6d::readScan(argv[2]).points;
  const bool gicp = std::strcmp(argv[3], "gicp") == 0;
  const long before = peakMemory();
  double least_wall = std::numeric_limits<double>::infinity();
  double least_processor = least_wall;
  pcl6d::IcpResult result;
  for (int i = 0; i < std::atoi(argv[4]); ++i) {
    const std::clock_t processor = std::clock();
    const auto wall = std::chrono::steady_clock::now();
    result = registerPair(target, source, gicp);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - wall;
    least_wall = std::min(least_wall, spent.count());
    least_processor =
        std::min(least_processor,
                 static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
  }
  std::printf("%.6f %.6f %d %.17g %ld %ld\n",
              least_wall,
              least_processor,
              result.iterations,
              result.T_target_source.translation().x(),
              before,
              peakMemory());
  return 0;
}
