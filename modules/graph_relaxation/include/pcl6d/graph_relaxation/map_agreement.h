// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief How well the scans of a map agree: a word on poses without knowing the truth
 * (share/doc/run_folder.md). */
struct MapAgreement {
  double total = 0;          ///< over all pairs of scans, both ways; in [-1, 1]
  std::vector<double> scans; ///< of each scan, over its pairs; 0 for one without pairs
};

/** \return the pairs of scans that see each other at some poses: at least 5 % of the
 * points of one have a point of the other within 2 voxels
 * \param[in] voxel [m] of the reduction
 * \param[in] num_threads 0: one per core; never changes the result
 * \param[in] sharing of the work between processes; null: this one does all
 * \throws BadArgument not one pose per scan */
std::vector<ScanPair>
visiblePairs(const std::vector<NetworkScan>& scans,
             const Poses& poses,
             double voxel,
             unsigned int num_threads = 0,
             WorkSharing* sharing = nullptr);

/** \return the distance [m] within which a point lies on a surface that was reduced to
 * this voxel [m]: voxel / 2.5 */
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

} // namespace pcl6d
