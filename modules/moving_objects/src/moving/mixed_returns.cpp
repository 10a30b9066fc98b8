// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"
#include "mixed_returns.h"
#include "thin_clusters.h"

namespace pcl6d::moving_objects {

namespace {
/** [cells] Width of the part of a ray image that decides on one direction: a cell and the cells
 * around. */
constexpr double kCellsLookedAt = 3;

/** [finest cells] Cells up to this width are of the finest level: the next has 1.5. */
constexpr double kFinestCells = 1.25;

/** [finest cells] Cells of the two finest levels: two of them are as wide as the beam and its halo. */
constexpr double kFineCells = 1.75;
} // namespace

bool
areMixedReturns(const TestedPositions& observed,
                const RayImage& own,
                const std::vector<std::size_t>& cluster)
{
  std::size_t between = 0;
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(cluster.size());
  for (const std::size_t place : cluster) {
    between += own.look(observed.places[place], 0).sight == Sight::kEdge ? 1 : 0;
    directions.push_back(observed.directionOf(place).cast<double>());
  }
  return 2 * between > cluster.size() &&
         (observed.cell < kFinestCells * RayImageOptions().finest ||
          arcWidthOf(directions) < kCellsLookedAt * observed.cell ||
          (observed.cell < kFineCells * RayImageOptions().finest &&
           !hasSolidPart(observed, own, cluster)));
}

} // namespace pcl6d::moving_objects
