// SPDX-License-Identifier: BSD-3-Clause
#include "grown_patch.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/line_growth.h>
#include <pcl6d/filters/scan_sampling.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr std::size_t kGrowthBlock = 256; // points

bool
hasLines(const ScanSampling& sampling)
{
  return sampling.structure == ScanStructure::kLines ||
         sampling.structure == ScanStructure::kRings;
}

/** \return the side of the voxels [m] among which patches grow; 0:
 * patches do not grow */
double
voxelOfGrowth(const Points& points, const Eigen::Vector3f& scanner, LineGrowth growth)
{
  if (growth == LineGrowth::kNever)
    return 0;
  const ScanSampling sampling = samplingOf(points, scanner);
  if (growth == LineGrowth::kAuto && !hasLines(sampling))
    return 0;
  return kVoxelOfLines *
         std::max(sampling.lineSpacing(), sampling.point_angle * sampling.median_range);
}

/** \return the finite points within a grid */
Points
pointsInGrid(const Points& points, double voxel)
{
  constexpr double kMostCells = 1 << 20; // of a VoxelKey, along an axis
  const double farthest = (kMostCells - 1) * voxel;
  Points inside;
  for (const auto& p : points)
    if (p.allFinite() && p.cast<double>().cwiseAbs().maxCoeff() < farthest)
      inside.push_back(p);
  return inside;
}
} // namespace

bool
growsAcrossLines(const Points& points,
                 const Eigen::Vector3f& scanner,
                 LineGrowth growth)
{
  return growth == LineGrowth::kAlways ||
         (growth == LineGrowth::kAuto && hasLines(samplingOf(points, scanner)));
}

LineSurface::LineSurface(const Points& points,
                         const Eigen::Vector3f& scanner,
                         LineGrowth growth,
                         unsigned int num_threads)
: scanner_(scanner), spacing_(voxelOfGrowth(points, scanner, growth))
{
  if (!(spacing_ > 0))
    return;
  ReductionOptions reduction;
  reduction.voxel = spacing_;
  reduced_ = reducePoints(pointsInGrid(points, spacing_), reduction);
  tree_.emplace(reduced_, num_threads);
}

SurfacePatch
LineSurface::patchAt(const Eigen::Vector3f& place) const
{
  if (!tree_ || !place.allFinite())
    return {};
  const auto range = static_cast<double>((place - scanner_).norm());
  return filters::grownPatch(place, range, reduced_, *tree_, spacing_);
}

void
growLines(const Points& places,
          const LineSurface& surface,
          std::vector<SurfacePatch>& patches,
          unsigned int num_threads)
{
  require(patches.size() == places.size(), "patches", patches.size(), "one per place");
  if (!surface.grows())
    return;
  parallelBlocks(places.size(), kGrowthBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (patches[i].normal.isZero(0) ||
          static_cast<double>(patches[i].breadth) <= filters::kLine)
        patches[i] = surface.patchAt(places[i]);
  });
}

Normals
estimateScanNormals(const Points& points,
                    const PointTree& tree,
                    const ScanNormals& options,
                    unsigned int num_threads)
{
  const LineSurface surface(
      points, Eigen::Vector3f::Zero(), options.growth, num_threads);
  if (!surface.grows())
    return estimateNormals(points, tree, options.neighbours, num_threads);
  Normals normals =
      filters::normalsOffLines(points, tree, options.neighbours, num_threads);
  parallelBlocks(points.size(), kGrowthBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      if (normals[i].isZero(0))
        normals[i] = surface.patchAt(points[i]).normal;
  });
  return normals;
}

} // namespace pcl6d
