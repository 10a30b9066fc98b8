// SPDX-License-Identifier: BSD-3-Clause
#include "surface_directions.h"

#include <pcl6d/registration/facing_surfaces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pcl6d {
using verification::FitDirections;
using verification::PairExtent;
using verification::SurfacePair;
using verification::SurfacePairs;

namespace {
/** Radius of the patch of a normal [max_distance]: ten points of three voxels, with pairs up to 1.7
 * voxels. Within it, the surface of a point is known. */
constexpr double kPatchReach = 3;

/** Cosine of two normals of a plane, 20 degrees. */
constexpr double kOnePlane = 0.94;

/** Scans of a link, one transformed into the frame of the other. */
struct PairDirection {
  const VerifiedScan& of; ///< whose points are tested
  const VerifiedScan& in; ///< whose surfaces they are paired with
  Eigen::Isometry3d T_in_of;
  Eigen::Isometry3d T_first_in;
  bool is_forward; ///< the points of the second scan are tested
};

/** Nearest point of the other scan. */
struct Facing {
  Eigen::Vector3d place, normal, other; ///< of the tested point, in the frame of `in`
  Eigen::Vector3d partner;

  /** In the frame of the first scan. Opposite direction: the point of the first scan moves, the
   * second stays. */
  SurfacePair
  pair(const PairDirection& way, double missing, double missing_other) const
  {
    return {way.T_first_in * (way.is_forward ? place : partner),
            way.T_first_in.linear() * normal,
            way.T_first_in.linear() * other,
            way.is_forward ? missing : -missing,
            way.is_forward ? missing_other : -missing_other};
  }
};

/** \return the nearest point, if its normal faces the same way: the two faces of a wall are never
 * paired */
std::optional<Facing>
facingOf(const PairDirection& way, std::size_t i, float limit_sq)
{
  const Normals& normals = way.in.surfaces().normals();
  const Eigen::Vector3d place =
      way.T_in_of * way.of.surfaces().points()[i].cast<double>();
  const Neighbour near =
      way.in.surfaces().tree().nearest(place.cast<float>(), limit_sq);
  if (near.index < 0)
    return std::nullopt;
  const auto k = static_cast<std::size_t>(near.index);
  const Eigen::Vector3d normal = normals[k].cast<double>();
  const Eigen::Vector3d other =
      way.T_in_of.linear() * way.of.surfaces().normals()[i].cast<double>();
  if (normals[k].isZero(0) || !(other.dot(normal) > 0))
    return std::nullopt;
  return Facing{place, normal, other, way.in.surfaces().points()[k].cast<double>()};
}

/** Pairs an even selection of the points of a scan with surfaces of another scan. */
void
pairEvenly(const PairDirection& way,
           const SurfaceFitOptions& options,
           SurfacePairs& found)
{
  const std::size_t count = way.of.surfaces().points().size();
  const std::size_t stride = std::max<std::size_t>(1, count / options.points);
  const auto limit_sq = static_cast<float>(options.max_distance * options.max_distance);
  for (std::size_t i = stride / 2; i < count; i += stride) {
    ++found.looked_at;
    if (const auto facing = facingOf(way, i, limit_sq)) {
      const Eigen::Vector3d offset = facing->partner - facing->place;
      found.pairs.push_back(
          facing->pair(way, facing->normal.dot(offset), facing->other.dot(offset)));
    }
  }
}

/** Pairs every point whose surface fixes a motion. Patches of one plane are paired, too,
 * where points of the patches are not near each other: lines of a scan are farther apart on a floor
 * than points. */
void
pairFacing(const PairDirection& way,
           const OpenMotion& motion,
           double max_distance,
           std::vector<SurfacePair>& pairs)
{
  const Points& points = way.of.surfaces().points();
  const Normals& normals = way.of.surfaces().normals();
  const Eigen::Isometry3d T_first_of = way.T_first_in * way.T_in_of;
  const double reach = kPatchReach * max_distance;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!motion.isFixedBy(T_first_of * points[i].cast<double>(),
                          T_first_of.linear() * normals[i].cast<double>()))
      continue;
    const auto facing = facingOf(way, i, static_cast<float>(reach * reach));
    if (!facing)
      continue;
    const Eigen::Vector3d offset = facing->partner - facing->place;
    const double missing = facing->normal.dot(offset);
    const double missing_other = facing->other.dot(offset);
    const bool is_near = offset.norm() < max_distance;
    const bool is_one_plane =
        facing->normal.dot(facing->other) > kOnePlane &&
        std::max(std::abs(missing), std::abs(missing_other)) < max_distance;
    const SurfacePair pair = facing->pair(
        way, 0.5 * (missing + missing_other), 0.5 * (missing + missing_other));
    if ((is_near || is_one_plane) && motion.isFixedBy(pair.place, pair.normal))
      pairs.push_back(pair);
  }
}

/** \return the number of cubes of the pairs, averaged over the grids */
std::size_t
cubesOf(const std::vector<SurfacePair>& pairs,
        const Eigen::Vector3d& centroid,
        double cube)
{
  std::size_t sum = 0;
  const verification::PairGrids grids = verification::gridsOf(pairs, centroid, cube);
  for (const auto& grid : grids)
    sum += grid.count;
  return sum / grids.size();
}

/** Adds the pairs of surfaces that fix an open motion, each as often as gives these pairs the share
 * of a motion. */
void
addFacing(const std::array<PairDirection, 2>& ways,
          const SurfaceFitOptions& options,
          SurfacePairs& found)
{
  if (found.pairs.size() < kLeastFacing)
    return;
  const PairExtent extent = verification::extentOf(found.pairs);
  const FitDirections directions = verification::directionsOf(found.pairs, extent);
  const std::size_t evenly = found.pairs.size();
  for (int axis = 0; axis < 6 && directions.isOpen(axis); ++axis) {
    std::vector<SurfacePair> facing;
    for (const PairDirection& way : ways)
      pairFacing(way,
                 {directions.axes.col(axis), extent.centroid},
                 options.max_distance,
                 facing);
    if (facing.size() < kLeastFacing ||
        cubesOf(facing, extent.centroid, options.cube_voxels * found.voxel) <
            kLeastFacingCubes)
      continue;
    const std::size_t copies = copiesOfFacing(facing.size(), evenly);
    for (SurfacePair& pair : facing) {
      pair.copies = static_cast<double>(copies);
      found.pairs.insert(found.pairs.end(), copies, pair);
    }
  }
}
} // namespace

SurfacePairs
verification::pairSurfaces(const VerifiedScan& first,
                           const VerifiedScan& second,
                           const Eigen::Isometry3d& T_first_second,
                           const SurfaceFitOptions& options)
{
  options.validate();
  const std::array<PairDirection, 2> ways{
      PairDirection{second, first, T_first_second, Eigen::Isometry3d::Identity(), true},
      PairDirection{first, second, T_first_second.inverse(), T_first_second, false}};
  SurfacePairs found;
  found.voxel = std::max(first.voxel(), second.voxel());
  for (const PairDirection& way : ways)
    pairEvenly(way, options, found);
  found.evenly = found.pairs.size();
  addFacing(ways, options, found);
  return found;
}

} // namespace pcl6d
