// SPDX-License-Identifier: BSD-3-Clause
#include "render/map_residuals.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace pcl6d::app {

namespace {
constexpr float kFarthest = 0.5F; // [m] beyond, the other scan did not see the surface
constexpr std::size_t kNearScans = 6; // number of scans searched for neighbours

/** A scan in the world, ready for searches. */
struct SearchedScan {
  Points points;
  PointTree tree;
};

/** The distance to the plane through some points, or else to the first point. */
float
distanceToSurface(const Eigen::Vector3f& place,
                  const Points& points,
                  const Neighbour* nearest,
                  std::size_t count)
{
  const float to_first = std::sqrt(nearest[0].distance_sq);
  if (count < 4)
    return to_first;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
    mean += points[static_cast<std::size_t>(nearest[i].index)].cast<double>();
  mean /= static_cast<double>(count);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d d =
        points[static_cast<std::size_t>(nearest[i].index)].cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const auto eigen = symmetricEigen<3>(scatter);
  if (eigen.values[0] > 0.1 * eigen.values[1])
    return to_first;
  const double off = eigen.vectors.col(0).dot(place.cast<double>() - mean);
  return std::min(to_first, static_cast<float>(std::abs(off)));
}

/** Per scan the kNearScans nearest scans, nearest first. */
std::vector<std::vector<std::size_t>>
nearScans(const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<std::vector<std::size_t>> near(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < poses.size(); ++k)
      if (k != i)
        others.emplace_back((poses[k].translation() - poses[i].translation()).norm(),
                            k);
    std::sort(others.begin(), others.end());
    for (std::size_t k = 0; k < std::min(kNearScans, others.size()); ++k)
      near[i].push_back(others[k].second);
  }
  return near;
}

float
residualOf(const Eigen::Vector3f& place,
           const std::vector<std::size_t>& others,
           const std::vector<SearchedScan>& scans)
{
  std::array<Neighbour, 8> best{};
  std::size_t best_count = 0, best_scan = 0;
  for (const auto scan : others) {
    std::array<Neighbour, 8> found{};
    const std::size_t count =
        scans[scan].tree.nearestK(place, found.size(), found.data());
    if (count > 0 && found[0].distance_sq <= kFarthest * kFarthest &&
        (best_count == 0 || found[0].distance_sq < best[0].distance_sq)) {
      best = found;
      best_count = count;
      best_scan = scan;
    }
  }
  if (best_count == 0)
    return std::numeric_limits<float>::quiet_NaN();
  return distanceToSurface(place, scans[best_scan].points, best.data(), best_count);
}
} // namespace

std::vector<float>
mapResiduals(const RunFolder& run, const RunMap& map)
{
  const auto poses = run.trajectory().poses;
  std::vector<SearchedScan> scans(poses.size());
  std::map<std::uint32_t, std::size_t> place_of;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    place_of[static_cast<std::uint32_t>(run.summary().scans[i].index)] = i;
    scans[i].points = transformed(run.readScan(i), poses[i]);
    scans[i].tree = PointTree(scans[i].points);
  }
  const auto near = nearScans(poses);
  std::vector<float> residuals(map.points.size(),
                               std::numeric_limits<float>::quiet_NaN());
  constexpr std::size_t kPointsPerBlock = 4096;
  parallelBlocks(residuals.size(), kPointsPerBlock, 0, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const auto scan = place_of.find(map.scans[i]);
      if (scan != place_of.end())
        residuals[i] = residualOf(map.points[i], near[scan->second], scans);
    }
  });
  return residuals;
}

} // namespace pcl6d::app
