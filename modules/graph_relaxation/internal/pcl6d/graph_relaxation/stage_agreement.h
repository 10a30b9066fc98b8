// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief Agreement before and after a change, over one set of points, with the standard
 * deviation of the difference by chance.
 * \ingroup graph_relaxation */
struct AgreementChange {
  double before = 0; ///< in [-1, 1]
  double after = 0;  ///< in [-1, 1]
  /** standard deviation of the difference by chance. The points of a cube (agreementCube())
   * are correlated and count as a single observation */
  double deviation = 0;

  /** \return whether the agreement fell by more than this multiple of its standard deviation */
  bool
  isLoss(double deviations = 3) const
  {
    return after < before - deviations * deviation;
  }
  /** \return whether the agreement rose by more than this multiple of its standard deviation */
  bool
  isGain(double deviations = 3) const
  {
    return after > before + deviations * deviation;
  }
};

/** \return the edge [m] of the cubes whose points count as one observation: 16 voxels, a piece
 * of a surface
 * \param[in] voxel [m] of the reduction */
double
agreementCube(double voxel);

/** \brief Agreement of a map before and after a stage, over one set of points and pairs of scans.
 *
 * A point with a neighbour in the other scan, at most 2 voxels away, counts 1 / (1 + r^2 /
 * s^2). Here r = |n . d| with the normal n of the neighbour and its difference d, and s is the
 * robust standard deviation of the better of both maps: 1 on the surface, 1/2 at a distance of
 * s. A point without a neighbour counts 0, and -1 for a free-space violation. The scale
 * therefore follows from the scans, and a bent wall shows long before points lose their
 * partners. */
struct StageAgreement {
  AgreementChange total;
  std::vector<AgreementChange> scans; ///< per scan, over its points; zero without pairs
  std::size_t pairs = 0;              ///< pairs of scans that overlap before or after
  double deviation = 0; ///< s [m]; 0 if no point has a neighbour before and after

  /** \param[in] counted per scan: false excludes its points, for example of a scan with an
   * unreliable pose; empty: every scan counts
   * \return why the stage made the map worse, by more than chance: the total fell by more than
   * 3 standard deviations, or the agreement of a scan by more than 5 (because many scans are
   * tested) and by a tenth (its index is named); empty: not worse */
  Rejection
  worse(const std::vector<bool>& counted = {}) const;
};

/** \brief Tests a stage by the poses before and after.
 * \param[in] voxel [m] of the reduction
 * \param[in] num_threads 0: a thread per core; never changes the result
 * \param[in] sharing shares the work between processes; null: one process
 * \throws BadArgument not one pose per scan
 * \ingroup graph_relaxation */
StageAgreement
compareStage(const std::vector<NetworkScan>& scans,
             const Poses& before,
             const Poses& after,
             double voxel,
             unsigned int num_threads = 0,
             WorkSharing* sharing = nullptr);

} // namespace pcl6d
