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
      trusted; ///< whether each pose of the reference may be used; empty: every pose

  /** \throws BadArgument naming the invalid field and its value */
  void
  validate() const;
};

/** \brief Two poses to compare, by their indices. */
struct PosePair {
  std::size_t estimate = 0;
  std::size_t reference = 0;
};

/** \brief The pairs of poses, in the order of the estimate. */
struct PoseMatching {
  bool by_time = false; ///< else by index; a stamp may be an index
  std::vector<PosePair> pairs;
  std::size_t unmatched_estimate = 0;  ///< poses of the estimate without partner
  std::size_t unmatched_reference = 0; ///< poses of the reference without partner
  std::size_t untrusted = 0; ///< pairs left out because the reference is not trusted
};

/** \brief Finds the pairs of poses to compare.
 *
 * If both trajectories have stamps: by time, each pose at most once, closest stamps
 * first, up to the time difference of the option. Otherwise by index. If one trajectory
 * has stamps, and these are whole numbers below the length of the other, a stamp is the
 * index of its partner, as in the trajectory.tum of a run of selected scans; without
 * them equal indices belong together.
 * \throws BadArgument a trajectory is empty, has a pose that is not rigid, stamps that
 * do not increase, or not one stamp per pose; by equal indices: the lengths differ;
 * trusted has not one entry per reference pose
 * \throws ComputeFailed by time: no two stamps are close enough; no pair is trusted
 * \ingroup benchmarking */
PoseMatching
matchPoses(const Trajectory& estimate,
           const Trajectory& reference,
           const PoseMatchingOptions& options = PoseMatchingOptions());

} // namespace pcl6d
