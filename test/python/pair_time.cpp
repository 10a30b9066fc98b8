// SPDX-License-Identifier: BSD-3-Clause
// What the Python package costs: the same registration as pair_time.py, by the library alone.
// usage: pair_time TARGET SOURCE [REPEATS]
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/registration/icp_model.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {
pcl6d::IcpResult
registerPair(const pcl6d::Points& target_points, const pcl6d::Points& source_points)
{
  pcl6d::IcpOptions options;
  options.metric = pcl6d::Metric::kGicp;
  options.max_distance = 0.5;
  pcl6d::IcpModel::Options model;
  model.normals = true;
  const pcl6d::IcpModel target(target_points, model);
  const pcl6d::Points points = source_points; // as the package copies the arrays
  const auto normals = pcl6d::estimateNormals(points, pcl6d::PointTree(points));
  return icp(
      {target.part()}, {&points, &normals}, Eigen::Isometry3d::Identity(), options);
}
} // namespace

int
main(int argc, char** argv)
{
  if (argc < 3)
    return 2;
  const pcl6d::Points target = pcl6d::readScan(argv[1]).points;
  const pcl6d::Points source = pcl6d::readScan(argv[2]).points;
  std::vector<double> times;
  pcl6d::IcpResult result;
  for (int i = 0; i < (argc > 3 ? std::atoi(argv[3]) : 20); ++i) {
    const auto start = std::chrono::steady_clock::now();
    result = registerPair(target, source);
    times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
            .count());
  }
  std::sort(times.begin(), times.end());
  std::printf("C++:    least %.4f s, median %.4f s, %d iterations, x = %.17g\n",
              times.front(),
              times[times.size() / 2],
              result.iterations,
              result.T_target_source.translation().x());
  return 0;
}
