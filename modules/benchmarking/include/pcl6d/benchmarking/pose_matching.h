// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How poses of two trajectories belong together. \ingroup benchmarking */
struct PoseMatchingOptions {
  double max_time_difference = 0.02; ///< [s] between the stamps of a pair; >= 0
  std::vector<bool>
      trusted; ///< whether each pose of the reference may be compared with;
               ///< empty: all

  /** \throws BadArgument naming the field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Two poses that are compared, by their index. */
struct PosePair {
  std::size_t estimate = 0;
  std::size_t reference = 0;
};

/** \brief The pairs of poses, in the order of the estimate. */
struct PoseMatching {
  bool by_time = false; ///< else by index, which a stamp may be
  std::vector<PosePair> pairs;
  std::size_t unmatched_estimate = 0;  ///< poses of the estimate without partner
  std::size_t unmatched_reference = 0; ///< poses of the reference without partner
  std::size_t untrusted = 0; ///< pairs left out, as their reference is not trusted
};

/** \brief Finds which poses to compare.
 *
 * If both trajectories have stamps: by time, each pose at most once, closest stamps
 * first, none farther apart than the option says. Else by index: if the stamps of the
 * one that has them are whole numbers below the count of the other, as in the
 * trajectory.tum of a run of selected scans, a stamp is the index of its partner;
 * otherwise equal indices belong together.
 * \throws BadArgument a trajectory is empty, holds a pose that is not rigid, or stamps
 * that do not increase or are not as many as its poses; by index without such stamps: the counts differ;
 * trusted are not as many as the poses of the reference
 * \throws ComputeFailed by time: no two stamps are close enough; no pair is trusted
 * \ingroup benchmarking */
PoseMatching
matchPoses(const Trajectory& estimate,
           const Trajectory& reference,
           const PoseMatchingOptions& options = PoseMatchingOptions());

} // namespace pcl6d
