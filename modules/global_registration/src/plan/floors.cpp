// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "plan/floors.h"

#include <pcl6d/common/number_range.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** Number of points that vote for the height, and of tested heights per placement; the heights
 * are several steps apart. */
constexpr std::size_t kLevelPoints = 300, kHeights = 2;
constexpr int kApart = 4;

/** Heights within this number of steps are counted in bins; others, of scattered points, are sorted. */
constexpr std::size_t kMostBins = 1U << 14U;

/** \return the values in ascending order, each with its number */
std::vector<std::pair<int, int>>
countOf(std::vector<int> values)
{
  std::vector<std::pair<int, int>> counts;
  if (values.empty())
    return counts;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::int64_t first = *low, range = std::int64_t{*high} - first + 1;
  if (range < static_cast<std::int64_t>(kMostBins)) {
    std::vector<int> bins(static_cast<std::size_t>(range));
    for (const int value : values)
      ++bins[static_cast<std::size_t>(value - first)];
    for (std::size_t k = 0; k < bins.size(); ++k)
      if (bins[k] > 0)
        counts.emplace_back(static_cast<int>(first) + static_cast<int>(k), bins[k]);
    return counts;
  }
  std::sort(values.begin(), values.end());
  for (const int value : values) {
    if (counts.empty() || counts.back().first != value)
      counts.emplace_back(value, 0);
    ++counts.back().second;
  }
  return counts;
}

/** \param[in] votes for the number of steps, with the count of each; ascending */
std::vector<double>
mostVoted(const std::vector<std::pair<int, int>>& votes, double step)
{
  std::vector<std::pair<int, int>> best; // negative votes, height
  const auto countAt = [&](std::size_t i, std::int64_t place) {
    return i < votes.size() && votes[i].first == place ? votes[i].second : 0;
  };
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const auto [place, count] = votes[i];
    const int beside = (i > 0 ? countAt(i - 1, std::int64_t{place} - 1) : 0) +
                       countAt(i + 1, std::int64_t{place} + 1);
    best.emplace_back(-(beside + 2 * count), place);
  }
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
  std::vector<int> votes;
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
        votes.push_back(clampedTo<int>(std::floor((points_[k].z() - p.z()) / step)));
  }
  return mostVoted(countOf(std::move(votes)), step);
}

Floors::Cell
Floors::cellOf(const Eigen::Vector3d& p) const
{
  return {clampedTo<int>(std::floor(p.x() / cell_)),
          clampedTo<int>(std::floor(p.y() / cell_))};
}

} // namespace pcl6d::global_registration
