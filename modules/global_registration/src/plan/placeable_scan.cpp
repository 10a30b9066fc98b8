// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <algorithm>

namespace pcl6d {
using namespace global_registration;

namespace {
/** Points for the score of a pose: the share is accurate to 2 %. */
constexpr std::size_t kEvaluated = 600;

/** Points for matching: the pose is accurate to a fifth of a voxel. */
constexpr std::size_t kMatched = 2500;

PlaceableScan::Sample
sampleOf(const IcpModel& surfaces, std::size_t most)
{
  PlaceableScan::Sample sample;
  const std::size_t count = surfaces.points().size();
  const std::size_t number = std::min(count, most);
  for (std::size_t k = 0; k < number; ++k) {
    const std::size_t i = k * count / number;
    sample.points.push_back(surfaces.points()[i]);
    sample.normals.push_back(surfaces.normals()[i]);
  }
  return sample;
}

PlaceableScan::Ball
ballOf(const Points& points)
{
  PlaceableScan::Ball ball;
  for (const auto& p : points)
    ball.centre += p.cast<double>() / static_cast<double>(points.size());
  for (const auto& p : points)
    ball.radius = std::max(ball.radius, (p.cast<double>() - ball.centre).norm());
  return ball;
}
} // namespace

PlaceableScan::PlaceableScan(const VerifiedScan& scan,
                             const Eigen::Vector3d& expected_up)
: scan_(&scan)
, vertical_(estimateVertical(scan.surfaces().normals(), expected_up))
, cell_(planCell(scan.surfaces().points(),
                 scan.surfaces().normals(),
                 uprightRotation(vertical_.up),
                 scan.voxel()))
, evaluated_(sampleOf(scan.surfaces(), kEvaluated))
, matched_(sampleOf(scan.surfaces(), kMatched))
, ball_(ballOf(evaluated_.points))
{}

} // namespace pcl6d
