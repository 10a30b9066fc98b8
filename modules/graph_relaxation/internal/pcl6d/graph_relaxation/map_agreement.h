// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/network_scan.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief How well the scans of a map agree: a quality measure of poses without ground truth
 * (share/doc/run_folder.md). */
struct MapAgreement {
  double total = 0;          ///< over every pair of scans, both ways; in [-1, 1]
  std::vector<double> scans; ///< of each scan, over its pairs; 0 without pairs
};

/** \return the pairs of scans with common surfaces at some poses: at least 5 % of the points of
 * one scan have a point of the other within 2 voxels
 * \param[in] voxel [m] of the reduction
 * \param[in] num_threads 0: a thread per core; never changes the result
 * \param[in] sharing shares the work between processes; null: one process
 * \throws BadArgument not one pose per scan */
std::vector<ScanPair>
visiblePairs(const std::vector<NetworkScan>& scans,
             const Poses& poses,
             double voxel,
             unsigned int num_threads = 0,
             WorkSharing* sharing = nullptr);

/** \return [m] largest distance of a point from a surface reduced to the voxel [m], to count as
 * on the surface: voxel / 2.5 */
double
agreementDistance(double voxel);

/** \return the agreement of scans at some poses, over given pairs: the share of points of each
 * scan within agreementDistance() of the other, less the share of free-space violations
 * \throws BadArgument not one pose per scan, or an index of a pair out of range */
MapAgreement
agreementOver(const std::vector<ScanPair>& pairs,
              const std::vector<NetworkScan>& scans,
              const Poses& poses,
              double voxel,
              unsigned int num_threads = 0);

} // namespace pcl6d
