// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/registration/icp_options.h>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief Knobs of detectLoops(). */
struct LoopDetectionOptions {
  double max_distance = 5; ///< [m] between the positions, horizontally; > 0
  double max_height = 10; ///< [m] between the positions, vertically: heights drift; > 0
  /** per scan, of its position [m^2]: a candidate needs a squared Mahalanobis distance between
   * both positions below max_mahalanobis (positions count as independent); empty: no such gate */
  std::vector<Eigen::Matrix3d> position_covariances;
  double max_mahalanobis = 11.3;  ///< 99 % of a chi-square of 3 degrees (5.1.2); > 0
  std::size_t first = 0;          ///< index of a scan: no search
                                  ///< for loops of earlier scans
  std::size_t min_gap = 20;       ///< scans between both ends; > 0
  std::size_t min_pairs = 250;    ///< of points; > 0
  double min_overlap = 0.3;       ///< share of the points with a partner; in [0, 1]
  double max_rms_share = 0.66;    ///< of icp.max_distance; > 0
  double min_consistency = 0.8;   ///< near points / (near points +
                                  ///< free-space violations); in [0, 1]
  IcpOptions icp;                 ///< how candidates are matched
  WorkSharing* sharing = nullptr; ///< shares the work between
                                  ///< processes; null: one process
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Detects loop closures (book 5.1.2): scans near in space but not in time, matched from
 * small metascans ({j-1, j, j+1} and {n-1, n}). A loop is accepted by its number of pairs,
 * overlap, rms, free-space violations, and how well the surfaces fix the pose. In addition,
 * two loops close together in time must agree on the way between their ends (pairwise
 * consistency); a loop that contradicts its neighbours is rejected.
 *
 * From bad poses, where ICP alone fails, the octree overlap search is tried.
 * \param[in] usable per scan: false excludes the scan, for example an unregistered scan
 * \return every candidate with its result, in the order of its later scan; T_from_to is set
 * where matching converged
 * \throws BadArgument an invalid option; not one pose and flag per scan
 * \note Source: A. Nüchter, K. Lingemann, J. Hertzberg, H. Surmann, JFR 24(8/9), 2007; pairwise
 * consistency: J. G. Mangelson et al., ICRA 2018.
 * \ingroup graph_relaxation */
std::vector<ScanLink>
detectLoops(const std::vector<NetworkScan>& scans,
            const Poses& poses,
            const std::vector<bool>& usable,
            const LoopDetectionOptions& options);

} // namespace pcl6d
