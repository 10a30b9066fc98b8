// SPDX-License-Identifier: BSD-3-Clause
#include "point_grid.h"

#include <pcl6d/benchmarking/map_entropy.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
constexpr std::size_t kBlockSize = 64;            // places
constexpr double kLeastVariance = 1e-8;           // [m^2] of points on an exact plane
constexpr double kLogTwoPi = 1.83787706640934548; // ln(2 pi)

LocalSpread
spreadOf(const PointMoments& moments, std::size_t min_points)
{
  LocalSpread spread;
  spread.points = moments.count;
  spread.entropy = spread.variance = std::numeric_limits<double>::quiet_NaN();
  if (moments.count < min_points)
    return spread;
  const Eigen::Vector3d values =
      symmetricEigenvalues<3>(moments.covariance()).cwiseMax(kLeastVariance);
  spread.variance = values[0];
  spread.entropy = 1.5 * (kLogTwoPi + 1) + 0.5 * portableLog(values.prod());
  return spread;
}
} // namespace

void
MapEntropyOptions::validate() const
{
  require(std::isfinite(radius) && radius > 0, "radius", radius, "finite and > 0");
  require(min_points >= 4, "min_points", min_points, ">= 4");
}

std::vector<LocalSpread>
localSpreads(const Points& places, const Points& map, const MapEntropyOptions& options)
{
  options.validate();
  const PointGrid grid(map, options.radius);
  std::vector<LocalSpread> spreads(places.size());
  parallelBlocks(
      places.size(), kBlockSize, options.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i)
          spreads[i] = spreadOf(places[i].allFinite() ? grid.momentsAround(places[i])
                                                      : PointMoments(),
                                options.min_points);
      });
  return spreads;
}

} // namespace pcl6d
