// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_count_peer.h"

#include <pcl6d/common/random.h>
#include <pcl6d/filters/scan_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pcl6d::bench {

namespace {
constexpr double kLeastVoxel = 0.1;          // [m]
constexpr float kHit = 0.85F, kMiss = -0.4F; // log odds of p = 0.7 and 0.4
constexpr float kFewest = -2, kMost = 3.5F;  // of p = 0.12 and 0.97
constexpr std::uint32_t kNo = std::numeric_limits<std::uint32_t>::max();

using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

std::uint64_t
keyOf(const Cell& cell)
{
  constexpr std::int64_t kHalf = 1 << 20;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
    key = key << 21 | static_cast<std::uint64_t>(cell[axis] + kHalf);
  return key + 1; // 0: none
}

/** A voxel with points in it: others need no count. */
struct Voxel {
  std::uint64_t key = 0;
  float log_odds = 0;
  std::uint32_t hit_by = kNo, passed_by = kNo; // the last scan that did
};

/** A hash table of voxels, of fixed size. */
class Voxels {
public:
  explicit Voxels(std::size_t most)
  {
    while (slots_.size() < 2 * most)
      slots_.resize(2 * slots_.size());
  }
  /** \return the voxel, or the free place for it */
  Voxel&
  at(std::uint64_t key)
  {
    std::size_t place = mixBits(key) & (slots_.size() - 1);
    while (slots_[place].key != 0 && slots_[place].key != key)
      place = (place + 1) & (slots_.size() - 1);
    return slots_[place];
  }

private:
  std::vector<Voxel> slots_ = std::vector<Voxel>(64);
};

Cell
cellOf(const Eigen::Vector3d& p)
{
  return p.array().floor().cast<std::int64_t>();
}

/** Calls visit(cell) for those that a ray passes before the one where it ends (J. Amanatides,
 * A. Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987). In units of
 * voxels. */
template <typename Visit>
void
walk(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Visit visit)
{
  Cell cell = cellOf(from);
  const Cell last = cellOf(to);
  const Eigen::Vector3d way = to - from;
  Eigen::Vector3d next, step; // share of the way at the next wall, and between two
  for (int axis = 0; axis < 3; ++axis) {
    const double wall =
        static_cast<double>(cell[axis]) + (way[axis] > 0 ? 1 : 0) - from[axis];
    const bool moves = way[axis] != 0;
    next[axis] = moves ? wall / way[axis] : std::numeric_limits<double>::infinity();
    step[axis] = moves ? 1 / std::abs(way[axis]) : 0;
  }
  auto left = (last - cell).cwiseAbs().sum();
  for (; left > 0; --left) {
    visit(cell);
    int axis = 0;
    next.minCoeff(&axis);
    cell[axis] += way[axis] > 0 ? 1 : -1;
    next[axis] += step[axis];
  }
}

void
addScan(const std::vector<Eigen::Vector3d>& points,
        const Eigen::Vector3d& origin,
        std::uint32_t scan,
        Voxels& voxels)
{
  for (const auto& p : points) {
    Voxel& voxel = voxels.at(keyOf(cellOf(p)));
    if (voxel.hit_by != scan)
      voxel.log_odds = std::min(kMost, voxel.log_odds + kHit);
    voxel.hit_by = scan;
  }
  for (const auto& p : points)
    walk(origin, p, [&](const Cell& cell) {
      Voxel& voxel = voxels.at(keyOf(cell));
      if (voxel.key == 0 || voxel.hit_by == scan || voxel.passed_by == scan)
        return;
      voxel.passed_by = scan;
      voxel.log_odds = std::max(kFewest, voxel.log_odds + kMiss);
    });
}
} // namespace

std::vector<std::vector<PointMotion>>
countVoxels(const std::vector<Points>& scans,
            const std::vector<Eigen::Isometry3d>& T_world_scan)
{
  const double edge =
      std::max(kLeastVoxel, deriveScanParameters({}, scans).voxel.value);
  std::vector<std::vector<Eigen::Vector3d>> placed; // in voxels, from the first scan
  std::vector<Eigen::Vector3d> origins;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Eigen::Isometry3d T = T_world_scan.front().inverse() * T_world_scan[i];
    origins.emplace_back(T.translation() / edge);
    placed.emplace_back();
    for (const auto& p : scans[i])
      placed.back().emplace_back(T * p.cast<double>() / edge);
    count += scans[i].size();
  }
  Voxels voxels(count);
  for (const auto& points : placed)
    for (const auto& p : points) {
      const std::uint64_t key = keyOf(cellOf(p));
      voxels.at(key).key = key;
    }
  for (std::size_t i = 0; i < scans.size(); ++i)
    addScan(placed[i], origins[i], static_cast<std::uint32_t>(i), voxels);
  std::vector<std::vector<PointMotion>> motion(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const auto& p : placed[i])
      motion[i].push_back(voxels.at(keyOf(cellOf(p))).log_odds < 0
                              ? PointMotion::kDynamic
                              : PointMotion::kStatic);
  return motion;
}

} // namespace pcl6d::bench
