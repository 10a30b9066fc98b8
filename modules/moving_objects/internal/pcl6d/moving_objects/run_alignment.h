// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/moving_objects/compared_run.h>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of alignRuns(). */
struct RunAlignmentOptions {
  double voxel = 0.05; ///< [m] of the reduction of the scans; finite, > 0
  double reach = 4;    ///< voxels: largest distance of pairs in the first step; > 0
  bool move = true;    ///< false: poses are fixed, only covariances are computed
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Result of alignRuns(). */
struct RunAlignment {
  /** of the second run, as one piece, before the separate motion of its scans */
  Eigen::Isometry3d T_new_old = Eigen::Isometry3d::Identity();
  std::size_t pairs = 0; ///< of points of both runs; 0: no common surfaces
  double overlap = 0;    ///< share of the tested points with a partner
  double residual = 0;   ///< [m] standard deviation of the pairs across their surfaces
  /** [m] motion of the scans of the second run relative to the piece, rms */
  double bending = 0;
};

/** \brief Aligns a nearly registered run with another run, and finds the covariance of each
 * scan relative to the other run.
 *
 * The second run moves as one rigid piece by its points on the planes of the first, robustly,
 * so that changes do not bias the fit. Then each of its scans moves separately, as far as its
 * surfaces fix the pose, because the paths of two runs bend differently. The first run stays
 * fixed. The covariance of every scan of both runs is set: the covariance of its robust fit to
 * the other run, by cubes of points, plus the square of the remaining step. A scan without
 * common points takes the largest covariance of its run.
 * \throws BadArgument an invalid option, or a scan is not complete
 * \note Source: share/doc/trust.md, Covariance; weights of Geman and McClure
 * \ingroup moving_objects */
RunAlignment
alignRuns(ComparedRun& first,
          ComparedRun& second,
          const RunAlignmentOptions& options = {});

} // namespace pcl6d
