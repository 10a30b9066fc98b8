// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/place_starts.h"
#include "pair/place_support.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <array>

namespace pcl6d::global_registration {

namespace {
/** [plan cells] Size of the cells for level surfaces. */
constexpr double kFloorCells = 2;

/** Every start is scored by each fourth point: 150 per scan, for an error of the share of 4 %.
 * The best 100 are then scored by each point. */
constexpr std::size_t kGlance = 4, kEvaluatedStarts = 100;

/** Moves the starts for the full score to the front: the best, and the best of each likely
 * placement. \return their number */
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
        return count++ < kEvaluatedStarts || is_first;
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
  const auto evaluate = [&](std::size_t count, std::size_t each) {
    parallelFor(count, num_threads, [&](std::size_t i) {
      const Eigen::Isometry3d& T = starts[i].T_first_second;
      starts[i].score = supportOf(*first.scan, *second.scan, T, cell, 0.5 * cell, each)
                            .score(kContradictedStart);
    });
  };
  evaluate(starts.size(), kGlance);
  sortByScore(starts);
  starts.resize(keepBest(starts));
  evaluate(starts.size(), every);
  sortByScore(starts);
  return starts;
}

} // namespace pcl6d::global_registration
