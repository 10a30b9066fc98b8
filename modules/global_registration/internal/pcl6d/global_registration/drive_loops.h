// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A loop of a drive: two scans near each other, but farther apart by their poses. */
struct DriveLoop {
  std::size_t from = 0; ///< index of a scan
  std::size_t to = 0;   ///< index of a later scan
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity(); ///< [m]
  double drift = 0;   ///< [m] between the positions of `to` by its pose and by the loop
  bool counts = true; ///< false: contradicted by other loops
};

/** \brief Knobs of closeDriveLoops(). */
struct DriveLoopOptions {
  /** largest drift between two scans, as share of the way between them; in (0, 1]. Odometry
   * from scans drifts by 0.1 to 3 % (simulated drives), a wheel on carpet by 10 % */
  double max_drift = 0.1;
  /** [m] loops between nearer scans are left to detectLoops(). Default: the larger of half the
   * median range and 4 median steps, as for detectLoops() in a run; >= 0 */
  std::optional<double> near;
  std::size_t candidates = 3; ///< of each scan, by descriptors; > 0
  /** the search ends after this number of failures in a row; > 0 */
  std::size_t max_failures = 12;
  unsigned int num_threads = 0;   ///< 0: a thread per core; never changes the result
  ProgressCallback progress = {}; ///< "closing loops"; may throw to end it
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Result of closeDriveLoops(). */
struct DriveLoops {
  std::vector<DriveLoop> loops;         ///< in the order of their discovery
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan [m] after loop closure
  std::size_t searched = 0;             ///< pairs of scans tested by placeScan()
};

/** \brief Finds loop closures of a drive with more drift than a search around the poses can cover.
 *
 * Place descriptors rank the pairs by similarity, the most similar first. placeScan() tests a
 * pair if the poses of the two scans are apart, but no farther than drift explains. A loop
 * counts if its relative pose is unique and a neighbour in the drive fits there, too. Then the
 * poses are optimised over the drive and its loops, which brings further loops near enough to
 * need no search. Loops that contradict the rest are switched off. A search in the descriptor
 * tree visits only part of the descriptors, or every descriptor where drift allows few pairs.
 * The number of tested pairs grows with the number of loops, and ends after max_failures.
 * \param[in] scans of the drive in their order
 * \param[in] poses T_world_scan [m], one per scan; relative poses of neighbours are right
 * \return the poses unchanged if no loop is found
 * \throws BadArgument an invalid option, or the numbers of poses and scans differ
 * \note Source: candidates as in G. Kim, A. Kim, "Scan Context", IROS 2018; graduated
 * non-convexity for wrong loops, H. Yang et al., RA-L 2020
 * \ingroup global_registration */
DriveLoops
closeDriveLoops(const std::deque<PlaceableScan>& scans,
                const std::vector<Eigen::Isometry3d>& poses,
                const DriveLoopOptions& options = {});

/** \return whether closeDriveLoops() would search at all: whether any two poses are farther
 * apart than `near`, but no farther than drift explains
 * \param[in] reach [m] median range of the scans */
bool
mayHoldDriveLoops(const std::vector<Eigen::Isometry3d>& poses,
                  double reach,
                  const DriveLoopOptions& options = {});

} // namespace pcl6d
