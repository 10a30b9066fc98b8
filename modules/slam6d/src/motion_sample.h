// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/stage_agreement.h>
#include <pcl6d/registration/motion_icp.h>

#include <cstdint>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Draws evenly spread points of scans, of each about as many. */
class MotionSampler {
public:
  /** \param[in] voxel [m] to begin with */
  MotionSampler(double voxel, std::uint64_t seed) : voxel_(voxel), seed_(seed) {}

  /** \return measured points, at most one per voxel, whose edge is made to suit */
  TimedPoints
  draw(const TimedPoints& scan, std::size_t count);

private:
  double voxel_;
  std::uint64_t seed_;
};

/** \return every second point, from the first (0) or second (1) on: one half finds the
 * motion, the other one judges it */
TimedPoints
halfOf(const TimedPoints& sample, std::size_t first);

/** \return of each point how well it lies on the map, 1 on its plane, 1/2 where it is off by
 * what is expected, 0 without a plane \param[in] noise [m] added to what planes expect */
std::vector<double>
fitOf(const SurfaceMap& map,
      const std::vector<Eigen::Vector3d>& world,
      double noise,
      unsigned int num_threads);

/** \return their mean; 0 without any */
double
meanOf(const std::vector<double>& values);

/** \return the change of a mean over points, where those of one cube count as one
 * \param[in] points that tell the cube \param[in] cube [m] edge */
PCL6D_EXPORTS AgreementChange // shown to its test
changeOf(const std::vector<double>& before,
         const std::vector<double>& after,
         const Points& points,
         double cube);

/** \return the change over several scans, each as likely as the others */
AgreementChange
pooled(const std::vector<AgreementChange>& changes);

} // namespace pcl6d::slam6d
