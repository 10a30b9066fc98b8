// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/line.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/scene_interpretation/interpretation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl6d {
namespace {
constexpr std::size_t kLargest = 40; // largest planes, whose intersections are tried
constexpr double kLeastSine = 0.5;   // of the angle at an edge: 30 deg

enum class Fit { kNone, kLevel, kUpright };

Fit
fitOf(const Plane& plane, const Eigen::Vector3d& up, const SinCos& tau)
{
  const double cosine = std::abs(plane.normal.dot(up));
  if (cosine > tau.cos)
    return Fit::kLevel;
  return cosine < tau.sin ? Fit::kUpright : Fit::kNone;
}

std::vector<Eigen::Vector3d>
candidates(const std::vector<Plane>& planes)
{
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return planes[a].area > planes[b].area;
  });
  order.resize(std::min(order.size(), kLargest));
  std::vector<Eigen::Vector3d> directions;
  for (const auto i : order)
    directions.push_back(planes[i].normal);
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Plane &first = planes[order[a]], &second = planes[order[b]];
      const auto edge = meetOf(PlaneEquation{first.normal, first.offset},
                               PlaneEquation{second.normal, second.offset},
                               kLeastSine);
      if (edge)
        directions.push_back(edge->direction);
    }
  for (auto& direction : directions)
    if (direction.z() < 0)
      direction = -direction;
  return directions;
}

// Least-squares direction over the planes that fit, weighted by area.
Eigen::Vector3d
refined(const std::vector<Plane>& planes, const Eigen::Vector3d& up, const SinCos& tau)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& plane : planes) {
    const Fit fit = fitOf(plane, up, tau);
    const double weight = fit == Fit::kNone      ? 0
                          : fit == Fit::kUpright ? plane.area
                                                 : -plane.area;
    sum += weight * plane.normal * plane.normal.transpose();
  }
  const auto eigen = symmetricEigen<3>(sum);
  const Eigen::Vector3d direction = eigen.vectors.col(0);
  return direction.dot(up) < 0 ? Eigen::Vector3d(-direction) : direction;
}
} // namespace

std::optional<Eigen::Vector3d>
estimateUp(const std::vector<Plane>& planes, double tau, double max_tilt)
{
  constexpr double kEqual = 0.05; // share of area that decides between directions
  const SinCos angle = portableSinCos(tau);
  const double least = portableSinCos(max_tilt).cos;
  double total = 0;
  for (const auto& plane : planes)
    total += plane.area;
  std::optional<Eigen::Vector3d> best;
  double best_score = 0;
  for (const auto& direction : candidates(planes)) {
    if (direction.z() < least)
      continue;
    double area = 0;
    for (const auto& plane : planes)
      if (fitOf(plane, direction, angle) != Fit::kNone)
        area += plane.area;
    const double score = total > 0 ? area / total + kEqual * direction.z() : 1;
    if (score <= best_score)
      continue;
    best_score = score;
    best = direction;
  }
  for (int round = 0; best && round < 3; ++round)
    best = refined(planes, *best, angle);
  return best;
}

} // namespace pcl6d
