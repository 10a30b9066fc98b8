// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_numbers.h>
#include <pcl6d/filters/scan_sampling.h>
#include <pcl6d/verification/verified_scan.h>
#include <pcl6d/visibility/range_noise.h>
#include <pcl6d/visibility/ray_origin.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <cmath>

namespace pcl6d {

namespace {
/** \return the number of cubes with enough points for a patch */
std::size_t
patchesOf(const Points& points, double cube)
{
  constexpr std::size_t kLeastOfPatch = 4;
  VoxelNumbers cubes;
  std::vector<std::size_t> counts;
  std::size_t patches = 0;
  for (const auto& p : points) {
    if (!p.allFinite())
      continue;
    const auto [number, is_new] = cubes.add(voxelKey(p, cube));
    if (is_new)
      counts.push_back(0);
    if (++counts[number] == kLeastOfPatch)
      ++patches;
  }
  return patches;
}
} // namespace

VerifiedScan::VerifiedScan(const Points& measured,
                           const IcpModel& surfaces,
                           double voxel,
                           const Eigen::Vector3f& origin)
: surfaces_(&surfaces), voxel_(voxel)
{
  require(std::isfinite(voxel) && voxel > 0, "voxel", voxel, "finite and > 0");
  require(surfaces.normals().size() == surfaces.points().size(),
          "normals",
          surfaces.normals().size(),
          "one per point");
  RayImageOptions options;
  options.origin = origin;
  options.noise = rangeNoise(measured);
  options.between_lines =
      samplingOf(measured, origin).structure != ScanStructure::kEven;
  is_off_centre_ = !isPlausibleOrigin(measured, origin);
  rays_ = RayImage(is_off_centre_ ? Points() : measured, options);
  self_contradiction_ = pcl6d::selfContradiction(measured, origin, options.noise);
  patches_ = patchesOf(surfaces.points(), verification::kPatchVoxels * voxel);
}

bool
VerifiedScan::abstains() const
{
  return is_off_centre_ || self_contradiction_ > verification::kAbstainingShare ||
         isTooSmall();
}

bool
VerifiedScan::isTooSmall() const
{
  return patches_ < verification::kLeastOwnPatches;
}

} // namespace pcl6d
