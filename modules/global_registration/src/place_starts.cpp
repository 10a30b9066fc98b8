// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "place_starts.h"
#include "place_support.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <array>

namespace pcl6d::global_registration {

namespace {
/** Cells in which level surfaces are looked for, in cells of the plan. */
constexpr double kFloorCells = 2;

/** All starts are judged by each fourth point: 150 of each scan, whose share is known to 4 %;
 * so many of the best by all. */
constexpr std::size_t kGlance = 4, kJudgedStarts = 100;

/** Moves those that are judged fully to the front: the best, and the best of each trusted
 * placement. \return how many these are */
std::size_t
keepBest(std::vector<PlaceStart>& starts)
{
  std::array<bool, kTrustedPlacements> is_known{};
  std::size_t count = 0;
  const auto last =
      std::stable_partition(starts.begin(), starts.end(), [&](const PlaceStart& one) {
        bool is_first = false;
        if (one.placement < kTrustedPlacements) {
          is_first = !is_known[one.placement];
          is_known[one.placement] = true;
        }
        return count++ < kJudgedStarts || is_first;
      });
  return static_cast<std::size_t>(last - starts.begin());
}
} // namespace

void
sortByScore(std::vector<PlaceStart>& starts)
{
  std::stable_sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) {
    return a.score > b.score;
  });
}

UprightScan::UprightScan(const PlaceableScan& placeable,
                         const Eigen::Vector3d& up,
                         double cell)
: scan(&placeable)
, R_level_scan(uprightRotation(up))
, plan(drawPlan(placeable.scan().surfaces().points(),
                placeable.scan().surfaces().normals(),
                R_level_scan,
                cell))
, floors(placeable.scan().surfaces(), R_level_scan, kFloorCells * cell)
{}

std::vector<PlaceStart>
placeStarts(const UprightScan& first,
            const UprightScan& second,
            std::size_t placements,
            unsigned int num_threads,
            const PlanSearch& search,
            std::size_t every)
{
  const double cell = first.plan.cell;
  const double voxel =
      std::max(first.scan->scan().voxel(), second.scan->scan().voxel());
  std::vector<PlaceStart> starts;
  std::size_t placement = 0;
  for (const auto& placed : placePlan(first.plan, second.plan, placements, search)) {
    const SinCos turn = portableSinCos(placed.yaw);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<2, 2>() << turn.cos, -turn.sin, turn.sin, turn.cos;
    std::vector<double> heights = first.floors.heightsAbove(
        second.floors, R.topLeftCorner<2, 2>(), placed.shift, voxel);
    if (heights.empty())
      heights = {0};
    for (const double height : heights) {
      PlaceStart start;
      start.placement = placement;
      start.T_first_second.linear() =
          first.R_level_scan.transpose() * R * second.R_level_scan;
      start.T_first_second.translation() =
          first.R_level_scan.transpose() *
          Eigen::Vector3d(placed.shift.x(), placed.shift.y(), height);
      starts.push_back(start);
    }
    ++placement;
  }
  const auto judge = [&](std::size_t count, std::size_t each) {
    parallelFor(count, num_threads, [&](std::size_t i) {
      const Eigen::Isometry3d& T = starts[i].T_first_second;
      starts[i].score = supportOf(*first.scan, *second.scan, T, cell, 0.5 * cell, each)
                            .score(kContradictedStart);
    });
  };
  judge(starts.size(), kGlance);
  sortByScore(starts);
  starts.resize(keepBest(starts));
  judge(starts.size(), every);
  sortByScore(starts);
  return starts;
}

} // namespace pcl6d::global_registration
