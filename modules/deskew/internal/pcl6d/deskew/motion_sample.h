// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/deskew/motion_icp.h>
#include <pcl6d/graph_relaxation/stage_agreement.h>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {
namespace deskew {

/** \brief Draws evenly spread points from scans, about equally many from each. */
class MotionSampler {
public:
  /** \param[in] voxel [m] to begin with */
  MotionSampler(double voxel, std::uint64_t seed) : voxel_(voxel), seed_(seed) {}

  /** \return measured points, at most one per voxel; the voxel edge is adapted to the count */
  TimedPoints
  draw(const TimedPoints& scan, std::size_t count);

private:
  double voxel_;
  std::uint64_t seed_;
};

/** \return every second point, from the first (0) or second (1) on: one half is for estimation of
 * the motion, the second half for its test */
TimedPoints
halfOf(const TimedPoints& sample, std::size_t first);

/** \return how well each point lies on the map: 1 on its plane, 1/2 at the expected distance from
 * its plane, 0 without a plane \param[in] noise [m] added to the planes' deviation */
std::vector<double>
fitOf(const SurfaceMap& map,
      const std::vector<Eigen::Vector3d>& world,
      double noise,
      unsigned int num_threads);

/** \return their mean; 0 without any */
double
meanOf(const std::vector<double>& values);

/** \return the change of a mean over points; the points of a cube count as one sample
 * \param[in] points their positions, to assign the cubes \param[in] cube [m] edge */
AgreementChange
changeOf(const std::vector<double>& before,
         const std::vector<double>& after,
         const Points& points,
         double cube);

/** \return the change over several scans, with equal weights */
AgreementChange
pooled(const std::vector<AgreementChange>& changes);

} // namespace deskew
} // namespace pcl6d
