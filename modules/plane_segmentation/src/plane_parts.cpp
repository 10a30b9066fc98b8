// SPDX-License-Identifier: BSD-3-Clause
#include "plane_claims.h"
#include "plane_parts.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Makes the normal point to where most of the points were seen from. */
void
turnToSensor(const PlaneCloud& cloud, PlanePart& part)
{
  std::ptrdiff_t votes = 0;
  for (const auto i : part.points) {
    const Eigen::Vector3d ray = (cloud.viewpoint(i) - cloud.points()[i]).cast<double>();
    votes += part.plane.normal.dot(ray) < 0 ? -1 : 1;
  }
  if (votes < 0)
    part.plane.flip();
}
} // namespace

PlaneParts::PlaneParts(const PlaneCloud& cloud, const PlaneOptions& options)
: cloud_(cloud), options_(options)
{}

void
PlaneParts::start(const PlaneCandidates& candidates)
{
  parts_.clear();
  for (const auto& points : candidates) {
    parts_.emplace_back();
    parts_.back().points = points;
    std::sort(parts_.back().points.begin(), parts_.back().points.end());
  }
  fitAll();
}

/** Whether a point tells of the plane and not of an edge. */
bool
PlaneParts::supports(const PlanePart& part, std::uint32_t point) const
{
  const std::uint32_t surfel = cloud_.surfels().of_point[point];
  const Eigen::Vector3d normal = cloud_.normals()[point].cast<double>();
  return cloud_.surfels().smooth[surfel] &&
         std::abs(part.plane.normal.dot(normal)) > std::cos(options_.max_angle);
}

bool
PlaneParts::fit(PlanePart& part) const
{
  if (part.points.size() < 3)
    return false;
  const Eigen::Vector3d about = cloud_.points()[part.points.front()].cast<double>();
  PlaneSums all(about), firm(about);
  double squares = 0;
  const bool known = part.sums.count() > 0;
  for (const auto i : part.points) {
    const Eigen::Vector3d point = cloud_.points()[i].cast<double>();
    const double sigma = cloud_.surfels().noise[cloud_.surfels().of_point[i]];
    squares += sigma * sigma;
    all.add(point);
    if (known && supports(part, i))
      firm.add(point);
  }
  part.sums = 2 * firm.count() > part.points.size() ? firm : all;
  const auto plane = part.sums.fit();
  if (!plane)
    return false;
  part.plane = *plane;
  part.sigma = std::sqrt(squares / static_cast<double>(part.points.size()));
  turnToSensor(cloud_, part);
  return true;
}

void
PlaneParts::fitAll()
{
  std::vector<char> fitted(parts_.size());
  parallelFor(parts_.size(), cloud_.numThreads(), [&](std::size_t i) {
    fitted[i] = fit(parts_[i]);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (fitted[i] && kept++ != i)
      parts_[kept - 1] = std::move(parts_[i]);
  parts_.resize(kept);
}

void
PlaneParts::claim()
{
  const auto owners = claimPoints(cloud_, parts_, options_);
  for (auto& part : parts_)
    part.points.clear();
  for (std::uint32_t i = 0; i < owners.size(); ++i)
    if (owners[i] != kNoPart)
      parts_[owners[i]].points.push_back(i);
  fitAll();
}

std::vector<std::uint32_t>
PlaneParts::surfelsOf(const PlanePart& part) const
{
  std::vector<std::uint32_t> surfels;
  for (const auto i : part.points)
    surfels.push_back(cloud_.surfels().of_point[i]);
  std::sort(surfels.begin(), surfels.end());
  surfels.erase(std::unique(surfels.begin(), surfels.end()), surfels.end());
  return surfels;
}

} // namespace pcl6d
