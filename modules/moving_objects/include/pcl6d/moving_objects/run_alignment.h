// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/moving_objects/compared_run.h>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of alignRuns(). */
struct RunAlignmentOptions {
  double voxel = 0.05; ///< [m] of the reduction of the scans; finite, > 0
  double reach = 4;    ///< voxels: pairs are farther apart by less at first; > 0
  bool move = true;    ///< false: poses stay, only their covariances are found
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What alignRuns() found. */
struct RunAlignment {
  /** of the second run, in one piece, before its scans were moved each by itself */
  Eigen::Isometry3d T_new_old = Eigen::Isometry3d::Identity();
  std::size_t pairs = 0; ///< of points of both runs; 0: they have nothing in common
  double overlap = 0;    ///< share of the points looked at that have a partner
  double residual = 0;   ///< [m] standard deviation of the pairs across their surfaces
  /** [m] by which the scans of the second run were moved by themselves, rms */
  double bending = 0;
};

/** \brief Brings a run that lies nearly right exactly onto another one, and finds how well
 * each scan lies on the other run.
 *
 * The second run is moved in one piece by its points on the planes of the first, robustly, so
 * that what has changed does not pull; then each of its scans by itself, as far as its surfaces
 * fix it, as the paths of two runs bend differently. The first run stays. The covariance of
 * every scan of both runs is set: that of its robust fit to the other run, by cubes of points,
 * and the square of the step that is left. A scan without points in common takes the largest
 * one of its run.
 * \throws BadArgument an option breaks its rule, or a scan is not complete
 * \note Source: algorithms.md T.3; weights of Geman and McClure \ingroup moving_objects */
RunAlignment
alignRuns(ComparedRun& first,
          ComparedRun& second,
          const RunAlignmentOptions& options = {});

} // namespace pcl6d
