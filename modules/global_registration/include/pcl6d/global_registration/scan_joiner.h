// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/global_registration/pair_memory.h>
#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Result of joinScans() for one scan. */
struct JoinedScan {
  std::size_t group = 0; ///< index of its group; an unregistered
                         ///< scan is alone in a group
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::
      Identity();     ///< in the frame of the group's first scan, or of the known poses
  double overlap = 0; ///< share of its surfaces on surfaces of the group, in [0, 1]
  double contradiction = 0; ///< free-space violations / (violations + met surfaces)
  Rejection rejection;      ///< why the scan is unregistered, or its group is separate
};

/** \brief Result of joinScans(). */
struct JoinedScans {
  std::vector<JoinedScan> scans; ///< in the order of the scans
  /** the scans of each group in the order of joining: the largest group first, unregistered
   * scans last */
  std::vector<std::vector<std::size_t>> groups;
  std::size_t pairs_compared = 0, pairs_placed = 0;
  /** placed pairs that are not among JoinOptions::free_pairs, in ascending order */
  std::vector<std::pair<std::size_t, std::size_t>> pairs_paid;
  std::size_t pairs_left_out = 0; ///< likely pairs beyond JoinOptions::max_pairs
};

/** \brief The known pose of a scan in a group. */
struct KnownPlace {
  std::size_t group = 0; ///< any number; of merged groups,
                         ///< the frame of the smallest stays
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
};

/** \brief Knobs of joinScans(). */
struct JoinOptions {
  std::size_t pairs_per_scan = 4; ///< largest number of placeScan()
                                  ///< calls / number of scans; > 0
  /** largest number of placeScan() calls, on the likeliest pairs, beside the free ones; 0: no further
   * limit */
  std::size_t max_pairs = 0;
  /** pairs of indices, the lower first, placed in an earlier call with the same memory, and not
   * limited again; null: none */
  const std::set<std::pair<std::size_t, std::size_t>>* free_pairs = nullptr;
  double max_ambiguity = 0.6; ///< second score / score of an accepted pose; in [0, 1]
  /** known pose of each scan in a group. Relative poses within a known group stay fixed. Known
   * groups come first, by their numbers; empty: no pose is known */
  std::vector<std::optional<KnownPlace>> known = {};
  /** pairs allowed for comparison; empty: every pair. Pairs within a known group are never
   * compared */
  std::vector<std::pair<std::size_t, std::size_t>> pairs = {};
  PairMemory* memory = nullptr; ///< of earlier calls, and for later ones; null: none
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** "comparing" and "placing"; may throw to stop the search */
  ProgressCallback progress = {};
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Joins scans without initial poses, in any order.
 *
 * A quick comparison ranks every pair. placeScan() registers the best few pairs of each scan
 * and keeps every candidate. A group grows from the pair that most other pairs confirm. Each
 * remaining scan gets its candidate poses from any scan of the group, and is tested by the
 * points and rays of the whole group. The scan with the clearest pose joins, unless a scan of
 * the group contradicts the pose or a second pose fits nearly as well. In the end each scan is
 * tested again without itself. Remaining scans form further groups, or stay unregistered.
 * Groups, known groups too, are merged as rigid pieces where their relative pose is unique.
 * \param[in] scans with the same voxel; their order does not matter: ties are broken by content
 * \throws BadArgument an invalid option, the numbers of known poses and scans differ, or a pair
 * is not of two scans
 * \note Source: share/doc/place_recognition.md, Joint placement
 * \ingroup global_registration */
JoinedScans
joinScans(const std::deque<PlaceableScan>& scans, const JoinOptions& options = {});

} // namespace pcl6d
