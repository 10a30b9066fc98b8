// SPDX-License-Identifier: BSD-3-Clause
#include "grown_patch.h"
#include "least_spread.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/simd_clones.h>
#include <pcl6d/filters/point_normals.h>

#include <algorithm>
#include <array>

namespace pcl6d {

namespace {
constexpr std::size_t kMostNeighbours = 64;
constexpr std::size_t kBlockSize = 256; // points
constexpr std::size_t kLanes = filters::kSpreadLanes;
using Lanes = filters::SpreadLanes;
using filters::leastSpread;
using filters::Spread;
using filters::spreadOf;
using filters::Symmetric;
using Patch = std::array<Neighbour, kMostNeighbours>;

using FloatLanes = float __attribute__((vector_size(4 * kLanes)));

/** Offsets of the points from the place of a patch, one after another. */
struct PatchOffsets {
  using Real = double;
  const Patch& patch;
  const Points& points;
  const Eigen::Vector3f& place;

  PCL6D_INLINE void
  at(std::size_t k, Real* d) const
  {
    const Eigen::Vector3f& p = points[patch[k].index];
    for (int axis = 0; axis < 3; ++axis)
      d[axis] = static_cast<double>(p[axis] - place[axis]);
  }
};

/** PatchOffsets of kLanes patches. */
struct LanesOffsets {
  using Real = Lanes;
  const Patch* patches;
  const Points& points;
  const Eigen::Vector3f* places;

  PCL6D_INLINE void
  at(std::size_t k, Real* d) const
  {
    FloatLanes offset[3];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Eigen::Vector3f& p = points[patches[lane][k].index];
      for (int axis = 0; axis < 3; ++axis)
        offset[axis][lane] = p[axis] - places[lane][axis];
    }
    for (int axis = 0; axis < 3; ++axis)
      d[axis] = __builtin_convertvector(offset[axis], Lanes);
  }
};

/** \return sum of (p - place) (p - place)^T about the mean of the patch */
template <typename Offsets>
PCL6D_INLINE Symmetric<typename Offsets::Real>
scatterOf(const Offsets& offsets, std::size_t size)
{
  using Real = typename Offsets::Real;
  Real x{}, y{}, z{};
  Symmetric<Real> s{};
  for (std::size_t k = 0; k < size; ++k) {
    Real d[3];
    offsets.at(k, d);
    x += d[0];
    y += d[1];
    z += d[2];
    s.xx += d[0] * d[0];
    s.xy += d[0] * d[1];
    s.xz += d[0] * d[2];
    s.yy += d[1] * d[1];
    s.yz += d[1] * d[2];
    s.zz += d[2] * d[2];
  }
  const auto count = static_cast<double>(size);
  return {s.xx - x * x / count,
          s.xy - x * y / count,
          s.xz - x * z / count,
          s.yy - y * y / count,
          s.yz - y * z / count,
          s.zz - z * z / count};
}

/** \return towards the origin */
Eigen::Vector3f
normalFrom(const Spread<double>& spread,
           const Eigen::Vector3f& place,
           double line = filters::kLineTolerance)
{
  const Eigen::Vector3f normal = leastSpread(spread, line).cast<float>();
  return normal.dot(place) > 0 ? Eigen::Vector3f(-normal) : normal;
}

PCL6D_SIMD_CLONES void
spreadOfLanes(const LanesOffsets& offsets, std::size_t size, Spread<Lanes>& spread)
{
  spread = spreadOf(scatterOf(offsets, size));
}

Spread<double>
laneOf(const Spread<Lanes>& all, std::size_t lane)
{
  const auto& S = all.S;
  return {{S.xx[lane], S.xy[lane], S.xz[lane], S.yy[lane], S.yz[lane], S.zz[lane]},
          all.trace[lane],
          all.c1[lane],
          all.root[lane]};
}

void
requireNeighbours(std::size_t neighbours)
{
  require(neighbours >= 3 && neighbours <= kMostNeighbours,
          "neighbours",
          neighbours,
          "in [3, 64]");
}

Eigen::Vector3f
normalOfPatch(const Eigen::Vector3f& place,
              const Patch& patch,
              std::size_t size,
              const Points& points,
              double line = filters::kLineTolerance)
{
  if (size < 3)
    return Eigen::Vector3f::Zero();
  return normalFrom(
      spreadOf(scatterOf(PatchOffsets{patch, points, place}, size)), place, line);
}

/** kLanes normals. \return whether the patches had equal sizes, of 3 or more; if not, no
 * normal was written */
bool
normalsOfLanes(const Eigen::Vector3f* places,
               const PointTree& tree,
               const Points& points,
               std::size_t neighbours,
               double line,
               Eigen::Vector3f* normals)
{
  std::array<Patch, kLanes> patches;
  std::size_t size = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t found =
        tree.nearestK(places[lane], neighbours, patches[lane].data());
    if (found < 3 || (lane > 0 && found != size))
      return false;
    size = found;
  }
  Spread<Lanes> spread;
  spreadOfLanes({patches.data(), points, places}, size, spread);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    normals[lane] = normalFrom(laneOf(spread, lane), places[lane], line);
  return true;
}
} // namespace

Eigen::Vector3f
normalAt(const Eigen::Vector3f& place,
         const PointTree& tree,
         const Points& points,
         std::size_t neighbours)
{
  requireNeighbours(neighbours);
  Patch patch;
  const std::size_t size = tree.nearestK(place, neighbours, patch.data());
  return normalOfPatch(place, patch, size, points);
}

Eigen::Vector3f
normalOf(const Eigen::Vector3f& place,
         const std::vector<Neighbour>& nearest,
         const Points& points)
{
  Patch patch;
  const std::size_t size = std::min(nearest.size(), patch.size());
  std::copy_n(nearest.begin(), size, patch.begin());
  return normalOfPatch(place, patch, size, points);
}

namespace {
/** \param[in] line see leastSpread() */
Normals
normalsOfPatches(const Points& places,
                 const Points& points,
                 const PointTree& tree,
                 std::size_t neighbours,
                 double line,
                 unsigned int num_threads)
{
  requireNeighbours(neighbours);
  Normals normals(places.size());
  parallelBlocks(places.size(), kBlockSize, num_threads, [&](const Block& block) {
    std::size_t i = block.begin;
    while (i < block.end) {
      const std::size_t lanes_end = std::min(i + kLanes, block.end);
      if (lanes_end - i == kLanes &&
          normalsOfLanes(&places[i], tree, points, neighbours, line, &normals[i]))
        i = lanes_end;
      for (; i < lanes_end; ++i) {
        Patch patch;
        const std::size_t size = tree.nearestK(places[i], neighbours, patch.data());
        normals[i] = normalOfPatch(places[i], patch, size, points, line);
      }
    }
  });
  return normals;
}

/** Standard deviations of a patch, the second by the first, above which a grown patch is a surface:
 * half as wide as long (share/doc/sampling.md, Normals). */
constexpr double kFlat = 0.5;
/** Sizes of the patches tried in turn. */
constexpr std::size_t kGrown[] = {16, 24, 40, kMostNeighbours};
/** A patch wider than this share of its range, or this number of spacings, covers more
 * than one surface. */
constexpr double kWidestOfRange = 0.15, kWidestSpacings = 8;

} // namespace

SurfacePatch
filters::grownPatch(const Eigen::Vector3f& place,
                    double range,
                    const Points& points,
                    const PointTree& tree,
                    double spacing)
{
  const double widest = std::max(kWidestOfRange * range, kWidestSpacings * spacing);
  Patch patch;
  const std::size_t found = tree.nearestK(place, kMostNeighbours, patch.data());
  for (const std::size_t size : kGrown) {
    if (size > found || patch[size - 1].distance_sq > widest * widest)
      break;
    const auto spread = spreadOf(scatterOf(PatchOffsets{patch, points, place}, size));
    const Eigen::Vector3f normal = normalFrom(spread, place, kFlat * kFlat);
    if (!normal.isZero(0))
      return {normal,
              static_cast<float>(spread.root),
              static_cast<float>(filters::breadthOf(spread))};
  }
  return {};
}

Normals
filters::normalsOffLines(const Points& points,
                         const PointTree& tree,
                         std::size_t neighbours,
                         unsigned int num_threads)
{
  return normalsOfPatches(points, points, tree, neighbours, kLine * kLine, num_threads);
}

Normals
estimateNormals(const Points& places,
                const Points& points,
                const PointTree& tree,
                std::size_t neighbours,
                unsigned int num_threads)
{
  return normalsOfPatches(
      places, points, tree, neighbours, filters::kLineTolerance, num_threads);
}

Normals
estimateSurfaceNormals(const Points& points,
                       const PointTree& tree,
                       const Points& patches,
                       const PatchNormals& options)
{
  Normals normals = normalsOfPatches(points,
                                     patches,
                                     PointTree(patches, options.num_threads),
                                     options.neighbours,
                                     filters::kLine * filters::kLine,
                                     options.num_threads);
  parallelBlocks(
      points.size(), kBlockSize, options.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i)
          if (normals[i].isZero(0) && points[i].allFinite())
            normals[i] = filters::grownPatch(
                             points[i], points[i].norm(), points, tree, options.spacing)
                             .normal;
      });
  return normals;
}

} // namespace pcl6d
