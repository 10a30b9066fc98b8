// SPDX-License-Identifier: BSD-3-Clause
#include "least_spread.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/surface_patch.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
constexpr std::size_t kPatchBlock = 256; // places

/** The sums over the offsets of a patch. */
struct PatchSums {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::size_t count = 0;

  void
  add(const Eigen::Vector3f& offset)
  {
    if (!offset.allFinite())
      return;
    const Eigen::Vector3d d = offset.cast<double>();
    sum += d;
    squares += d * d.transpose();
    ++count;
  }
};

SurfacePatch
patchOf(const PatchSums& sums)
{
  if (sums.count < 3)
    return {};
  const Eigen::Matrix3d S =
      sums.squares - sums.sum * sums.sum.transpose() / static_cast<double>(sums.count);
  const filters::Spread<double> spread = filters::spreadOf(
      filters::Symmetric<double>{S(0, 0), S(0, 1), S(0, 2), S(1, 1), S(1, 2), S(2, 2)});
  const Eigen::Vector3f normal = filters::leastSpread(spread).cast<float>();
  if (normal.isZero(0))
    return {};
  return {normal,
          static_cast<float>(spread.root),
          static_cast<float>(filters::breadthOf(spread))};
}
} // namespace

SurfacePatch
fitPatch(const Points& offsets)
{
  PatchSums sums;
  for (const auto& offset : offsets)
    sums.add(offset);
  return patchOf(sums);
}

void
PatchSize::validate() const
{
  require(
      !(neighbours > 0 && radius != 0),
      "radius",
      radius,
      "0 if the number of neighbours is given: set either the radius or the number");
  require(neighbours > 0 || (radius > 0 && std::isfinite(radius)),
          "radius",
          radius,
          "finite and > 0 where no number of neighbours is given");
}

std::vector<SurfacePatch>
fitPatches(const Points& places,
           const Points& points,
           const PointTree& tree,
           const PatchSize& size,
           unsigned int num_threads)
{
  size.validate();
  std::vector<SurfacePatch> patches(places.size());
  constexpr double kMost = std::numeric_limits<float>::max();
  const auto radius_sq = static_cast<float>(std::min(size.radius * size.radius, kMost));
  const std::size_t k = std::min(size.neighbours, points.size());
  parallelBlocks(places.size(), kPatchBlock, num_threads, [&](const Block& block) {
    std::vector<Neighbour> found(k);
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (size.neighbours == 0)
        found = tree.withinRadius(places[i], radius_sq);
      const std::size_t count = size.neighbours == 0
                                    ? found.size()
                                    : tree.nearestK(places[i], k, found.data());
      PatchSums sums;
      for (std::size_t n = 0; n < count; ++n)
        sums.add(points[static_cast<std::size_t>(found[n].index)] - places[i]);
      patches[i] = patchOf(sums);
    }
  });
  return patches;
}

} // namespace pcl6d
