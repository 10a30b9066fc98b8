// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How well the scans of a map agree: a word on poses without knowing the truth
 * (share/doc/run_folder.md). */
struct MapAgreement {
  double total = 0;          ///< over all pairs of scans, both ways; in [-1, 1]
  std::vector<double> scans; ///< of each scan, over its pairs; 0 for one without pairs
};

/** \brief Both sides of a stage, over the same pairs of scans. */
struct StageAgreement {
  MapAgreement before, after;
  std::size_t pairs = 0; ///< of scans that see each other before or after

  /** \param[in] counted per scan: false leaves its own share out, such as that of one
   * whose pose is not to be trusted anyway; empty: all count
   * \return why the stage made the map worse: the total fell by more than 0.005, or that
   * of a scan by more than 0.05 (its index is named); empty: it did not */
  std::string
  worse(const std::vector<bool>& counted = {}) const;
};

/** \return the pairs of scans that see each other at some poses: at least 5 % of the
 * points of one have a point of the other within 2 voxels
 * \param[in] voxel [m] of the reduction
 * \param[in] num_threads 0: one per core; never changes the result
 * \throws BadArgument not one pose per scan */
std::vector<ScanPair>
visiblePairs(const std::vector<NetworkScan>& scans,
             const Poses& poses,
             double voxel,
             unsigned int num_threads = 0);

/** \return the distance [m] within which a point lies on a surface that was reduced to
 * this voxel [m]: max(3 cm, voxel / 2.5) */
double
agreementDistance(double voxel);

/** \return how well scans agree at some poses, over given pairs of them: the share of
 * points of each within agreementDistance() of the other, less those that lie where it
 * looked through
 * \throws BadArgument not one pose per scan, or a pair is not of them */
MapAgreement
agreementOver(const std::vector<ScanPair>& pairs,
              const std::vector<NetworkScan>& scans,
              const Poses& poses,
              double voxel,
              unsigned int num_threads = 0);

/** \brief Judges a stage by the poses before and after it: the share of points of each
 * scan within a distance of each other scan that sees the same places, less those that
 * lie where that scan looked through.
 * \param[in] voxel [m] of the reduction; points agree within agreementDistance()
 * \param[in] num_threads 0: one per core; never changes the result
 * \throws BadArgument not one pose per scan \ingroup graph_relaxation */
StageAgreement
judgeStage(const std::vector<NetworkScan>& scans,
           const Poses& before,
           const Poses& after,
           double voxel,
           unsigned int num_threads = 0);

} // namespace pcl6d
