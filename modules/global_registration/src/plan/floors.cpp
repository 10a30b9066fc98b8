// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "plan/floors.h"

#include <pcl6d/common/number_range.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::global_registration {

namespace {
/** Number of points that vote for the height, and of tested heights per placement; the heights
 * are several steps apart. */
constexpr std::size_t kLevelPoints = 300, kHeights = 2;
constexpr int kApart = 4;

std::vector<double>
mostVoted(const std::map<int, int>& votes, double step)
{
  std::vector<std::pair<int, int>> best; // negative votes, height
  const auto at = [&](int place) {
    const auto found = votes.find(place);
    return found == votes.end() ? 0 : found->second;
  };
  for (const auto& [place, count] : votes)
    best.emplace_back(-(at(place - 1) + 2 * count + at(place + 1)), place);
  std::sort(best.begin(), best.end());
  std::vector<double> heights;
  std::vector<int> taken;
  for (const auto& one : best) {
    if (heights.size() == kHeights)
      break;
    if (std::any_of(taken.begin(), taken.end(), [&](int other) {
          return std::abs(other - one.second) < kApart;
        }))
      continue;
    taken.push_back(one.second);
    heights.push_back((one.second + 0.5) * step);
  }
  return heights;
}
} // namespace

Floors::Floors(const IcpModel& surfaces,
               const Eigen::Matrix3d& R_level_scan,
               double cell)
: cell_(cell)
{
  for (std::size_t i = 0; i < surfaces.points().size(); ++i) {
    const Eigen::Vector3d n = R_level_scan * surfaces.normals()[i].cast<double>();
    if (std::abs(n.z()) < kLevel)
      continue;
    const Eigen::Vector3d p = R_level_scan * surfaces.points()[i].cast<double>();
    points_.push_back(p);
    up_.push_back(n.z() > 0);
    heights_[cellOf(p)].push_back(points_.size() - 1);
  }
}

std::vector<double>
Floors::heightsAbove(const Floors& other,
                     const Eigen::Matrix2d& R,
                     const Eigen::Vector2d& shift,
                     double step) const
{
  std::map<int, int> votes;
  const std::size_t stride =
      std::max<std::size_t>(1, other.points_.size() / kLevelPoints);
  for (std::size_t i = 0; i < other.points_.size(); i += stride) {
    Eigen::Vector3d p = other.points_[i];
    p.head<2>() = R * p.head<2>() + shift;
    const auto found = heights_.find(cellOf(p));
    if (found == heights_.end())
      continue;
    for (const std::size_t k : found->second)
      if (up_[k] == other.up_[i])
        ++votes[clampedTo<int>(std::floor((points_[k].z() - p.z()) / step))];
  }
  return mostVoted(votes, step);
}

Floors::Cell
Floors::cellOf(const Eigen::Vector3d& p) const
{
  return {clampedTo<int>(std::floor(p.x() / cell_)),
          clampedTo<int>(std::floor(p.y() / cell_))};
}

} // namespace pcl6d::global_registration
