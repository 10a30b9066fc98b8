// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sweep_motion.h"

#include <pcl6d/common/points.h>

namespace pcl6d::odometry {

/** \brief The finite points of a sweep, in order, and the span of their times. */
struct SweepSpan {
  SweepPoints points;
  double begin = 0; ///< [s] since the stamp; of a sweep without times 0
  double end = 0;   ///< [s] equal to begin: the points were measured at once
};

/** \param[in] times [s] since the stamp, one per point, or empty; points without a finite time are
 * left out \param[in] max_range [m] points beyond are left out
 * \throws BadArgument not one time per point */
SweepSpan
spanOf(const Points& points, const std::vector<double>& times, double max_range);

/** \return the first point of each voxel [m], in the order of the sweep */
SweepPoints
thinned(const SweepPoints& points, double voxel);

/** \brief Samples about a given number of points, evenly over the surfaces: the first point of each
 * voxel. The edge of the voxels follows from the count of the last sample. */
class SweepSampler {
public:
  /** \param[in] voxel [m] edge at the begin, and the smallest edge \param[in] wanted points */
  SweepSampler(double voxel, std::size_t wanted)
  : voxel_(voxel), least_(voxel), wanted_(wanted)
  {}

  SweepPoints
  sample(const SweepPoints& points);

private:
  double voxel_;
  double least_;
  std::size_t wanted_;
};

/** \return places [m, world] as points in the frame of a sweep */
Points
inFrameOf(const Eigen::Isometry3d& T_world_sweep,
          const std::vector<Eigen::Vector3d>& places);

/** \return the range [m] within which a share of the points lies; 0 without points */
double
rangeOfShare(const SweepPoints& points, double share);

} // namespace pcl6d::odometry
