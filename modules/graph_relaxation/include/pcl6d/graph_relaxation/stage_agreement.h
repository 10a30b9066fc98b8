// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief How well something agrees before and after a change, over the same points, and how
 * much of the difference is chance. \ingroup graph_relaxation */
struct AgreementChange {
  double before = 0; ///< in [-1, 1]
  double after = 0;  ///< in [-1, 1]
  double deviation =
      0; ///< standard deviation of their difference by chance: points of one
         ///< cube count as one, as they come to lie on a surface together

  /** \return whether it fell by more than chance does: by more than so many deviations */
  bool
  isLoss(double deviations = 3) const
  {
    return after < before - deviations * deviation;
  }
  /** \return whether it rose by more than chance does */
  bool
  isGain(double deviations = 3) const
  {
    return after > before + deviations * deviation;
  }
};

/** \return the edge [m] of the cubes whose points count as one: 16 voxels, a piece of a
 * surface \param[in] voxel [m] of the reduction */
double
agreementCube(double voxel);

/** \brief How a map agrees before and after a stage, over the same points of the same pairs of
 * scans.
 *
 * A point whose neighbour in the other scan, at most 2 voxels away, has a normal n and is d
 * away counts 1 / (1 + r^2 / s^2), r = |n . d|: 1 on the surface, 1/2 where it is off by the
 * robust standard deviation s of the better of both maps. One without a neighbour counts 0,
 * and -1 where the other scan looked through. So all that is compared has the scale of the
 * scans themselves, and a bent wall shows long before points miss each other. */
struct StageAgreement {
  AgreementChange total;
  std::vector<AgreementChange>
      scans;             ///< of each scan's points; zero for one without pairs
  std::size_t pairs = 0; ///< of scans that see each other before or after
  double deviation = 0;  ///< s [m]; 0 if no point has a neighbour before and after

  /** \param[in] counted per scan: false leaves its own points out, such as those of one
   * whose pose is not to be trusted anyway; empty: all count
   * \return why the stage made the map worse, by more than chance does: the total fell by more
   * than 3 standard deviations, or that of a scan by more than 5, as many are asked, and by a
   * tenth (its index is named); empty: it did not */
  std::string
  worse(const std::vector<bool>& counted = {}) const;
};

/** \brief Judges a stage by the poses before and after it.
 * \param[in] voxel [m] of the reduction
 * \param[in] num_threads 0: one per core; never changes the result
 * \param[in] sharing of the work between processes; null: this one does all
 * \throws BadArgument not one pose per scan \ingroup graph_relaxation */
StageAgreement
judgeStage(const std::vector<NetworkScan>& scans,
           const Poses& before,
           const Poses& after,
           double voxel,
           unsigned int num_threads = 0,
           WorkSharing* sharing = nullptr);

} // namespace pcl6d
