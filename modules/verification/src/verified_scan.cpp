// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"

#include <pcl6d/common/require.h>
#include <pcl6d/verification/verified_scan.h>
#include <pcl6d/visibility/range_noise.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <cmath>

namespace pcl6d {

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
  rays_ = RayImage(measured, options);
  self_contradiction_ = pcl6d::selfContradiction(measured, origin, options.noise);
}

bool
VerifiedScan::abstains() const
{
  return self_contradiction_ > verification::kAbstainingShare;
}

} // namespace pcl6d
