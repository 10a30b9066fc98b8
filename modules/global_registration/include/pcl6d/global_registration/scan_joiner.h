// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What became of a scan that was to be joined with others. */
struct JoinedScan {
  std::size_t group = 0; ///< place of its group; a loose scan is alone in one
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::
      Identity(); ///< in the frame of the group's first scan, or of the known poses
  double overlap =
      0; ///< share of its surfaces that meet others of the group, in [0, 1]
  double contradiction =
      0; ///< of these and those that others looked through, the latter
  std::string
      reason; ///< why it is loose, or its group no part of a larger one; else empty
};

/** \brief What joinScans() found. */
struct JoinedScans {
  std::vector<JoinedScan> scans; ///< in the order of the scans
  /** of each group its scans, in the order in which they were joined: the largest group
   * first, loose scans last */
  std::vector<std::vector<std::size_t>> groups;
  std::size_t pairs_compared = 0, pairs_placed = 0;
};

/** \brief The place of a scan in a group that is known. */
struct KnownPlace {
  std::size_t group =
      0; ///< any number; of groups that meet, the frame of the smallest stays
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
};

/** \brief Knobs of joinScans(). */
struct JoinOptions {
  std::size_t pairs_per_scan =
      4; ///< so many times the scans pairs are placed, at most; > 0
  double max_ambiguity =
      0.6; ///< second score / score of a place that counts; in [0, 1]
  /** of each scan its place in a group, if it is known: scans of a known group keep their
   * places to each other, and such groups come first, by their numbers; empty: none is known */
  std::vector<std::optional<KnownPlace>> known = {};
  /** pairs that may be looked at; empty: all. Pairs within a known group never are */
  std::vector<std::pair<std::size_t, std::size_t>> pairs = {};
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** told of "comparing" and "placing"; may throw, which ends it */
  ProgressCallback progress = {};
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Joins scans without any guess of where they were taken, in any order.
 *
 * All pairs are looked at quickly; the best few of each scan are placed (placeScan()), and
 * all their candidates kept. From the pair that most others confirm a group grows: each scan
 * that is left is placed by its candidates on any scan of the group, and judged by the points
 * and rays of all of them together; the clearest is joined, unless a scan of the group
 * contradicts it or another place is nearly as good. In the end each scan is judged again
 * without itself. What is left forms further groups, or stays loose. Groups, known ones too,
 * are joined in one piece where they have one place on each other.
 * \param[in] scans with the same voxel; their order does not matter: ties are broken by their
 * content
 * \throws BadArgument an option breaks its rule, known places are not one per scan, or
 * pairs are not of two scans
 * \note Source: algorithms.md G.2, G.4 \ingroup global_registration */
JoinedScans
joinScans(const std::deque<PlaceableScan>& scans, const JoinOptions& options = {});

} // namespace pcl6d
