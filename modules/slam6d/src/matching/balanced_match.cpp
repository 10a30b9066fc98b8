// SPDX-License-Identifier: BSD-3-Clause
#include "matching/balanced_match.h"

#include <pcl6d/common/voxel_numbers.h>
#include <pcl6d/registration/facing_surfaces.h>

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** Points of an even selection: enough for a pose, as while the pair distance shrinks, twice for
 * its residual error. */
constexpr std::size_t kEvenPoints = 3000;

/** Edge of a cube whose pairs count as one observation [max_distance]: 16 voxels, with pairs up to
 * 1.7 voxels (share/doc/trust.md, Surfaces). */
constexpr double kFacingCube = 16 / 1.7;

/** \return whether a surface of the target that fixes the motion is near, and faces the same way */
bool
hasFacing(const IcpTarget& target,
          const OpenMotion& motion,
          const Eigen::Vector3d& place,
          const Eigen::Vector3d& normal,
          double reach)
{
  auto least_sq = static_cast<float>(reach * reach);
  bool is_facing = false;
  for (const IcpTargetPart& part : target) {
    if (!part.tree || !part.normals)
      return false;
    const Neighbour near = part.tree->nearest(
        (part.T_target_part.inverse() * place).cast<float>(), least_sq);
    if (near.index < 0)
      continue;
    least_sq = near.distance_sq;
    const Eigen::Vector3d other =
        part.T_target_part.linear() *
        (*part.normals)[static_cast<std::size_t>(near.index)].cast<double>();
    is_facing = normal.dot(other) > 0 && motion.isFixedBy(place, other);
  }
  return is_facing;
}

/** \return the indices of source points on surfaces that fix a motion, in both scans; empty if these
 * are too few */
std::vector<std::size_t>
facingPoints(const IcpTarget& target,
             const IcpSource& source,
             const Eigen::Isometry3d& T_target_source,
             const OpenMotion& motion,
             const IcpOptions& options)
{
  // Along an open motion the pose is as uncertain as before the match.
  const double reach = std::max(options.max_distance, options.max_distance_start);
  const double cube = kFacingCube * options.max_distance;
  std::vector<std::size_t> facing;
  VoxelNumbers cubes;
  std::size_t num_cubes = 0;
  for (std::size_t i = 0; i < source.points->size(); ++i) {
    const Eigen::Vector3d place = T_target_source * (*source.points)[i].cast<double>();
    const Eigen::Vector3d normal =
        T_target_source.linear() * (*source.normals)[i].cast<double>();
    if (!place.allFinite() || !motion.isFixedBy(place, normal) ||
        !hasFacing(target, motion, place, normal, reach))
      continue;
    facing.push_back(i);
    num_cubes += cubes.add(voxelKey((*source.points)[i], cube)).second ? 1 : 0;
  }
  if (facing.size() < kLeastFacing || num_cubes < kLeastFacingCubes)
    facing.clear();
  return facing;
}

/** Points with their normals. */
struct Selection {
  Points points;
  Normals normals;

  void
  add(const IcpSource& source, std::size_t i, std::size_t copies)
  {
    points.insert(points.end(), copies, (*source.points)[i]);
    normals.insert(normals.end(), copies, (*source.normals)[i]);
  }
};

/** \return an even selection, and the points that face the open motions; empty if a motion stays
 * open */
Selection
balancedPoints(const IcpTarget& target,
               const IcpSource& source,
               const IcpResult& found,
               const IcpOptions& options)
{
  Selection selection;
  const std::size_t stride =
      std::max<std::size_t>(1, source.points->size() / kEvenPoints);
  for (std::size_t i = stride / 2; i < source.points->size(); i += stride)
    selection.add(source, i, 1);
  const std::size_t evenly = selection.points.size();
  const Localizability& fixed = *found.localizability;
  for (int k = 0; k < fixed.openDirections(); ++k) {
    const std::vector<std::size_t> facing =
        facingPoints(target,
                     source,
                     found.T_target_source,
                     {fixed.directions.col(k), fixed.centroid},
                     options);
    if (facing.empty())
      return {};
    for (const std::size_t i : facing)
      selection.add(source, i, copiesOfFacing(facing.size(), evenly));
  }
  return selection;
}
} // namespace

void
matchBalanced(const IcpTarget& target,
              const IcpSource& source,
              const IcpOptions& options,
              IcpResult& found)
{
  if (!found.localizability || found.localizability->openDirections() == 0 ||
      !source.normals || source.normals->size() != source.points->size())
    return;
  const Selection selection = balancedPoints(target, source, found, options);
  if (selection.points.empty())
    return;
  IcpOptions further = options;
  further.shrinking_stride = 1;
  const IcpResult balanced = icp(
      target, {&selection.points, &selection.normals}, found.T_target_source, further);
  if (balanced.status != Status::kOk)
    return;
  found.T_target_source = balanced.T_target_source;
  found.status = balanced.status;
  found.stop = balanced.stop;
  found.iterations += balanced.iterations;
  found.information = balanced.information;
  found.covariance = balanced.covariance;
  found.localizability = balanced.localizability;
}

} // namespace pcl6d::slam6d
