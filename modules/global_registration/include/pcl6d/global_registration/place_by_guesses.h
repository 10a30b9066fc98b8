// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/global_registration/placeable_scan.h>
#include <pcl6d/verification/link_evidence.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan with a known pose, a reference for further scans. */
struct KnownScan {
  const PlaceableScan* scan = nullptr;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief The best pose of a scan found from initial poses. */
struct GuessedPlace {
  bool accepted = false;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  std::size_t guess = 0;    ///< index of the initial pose that led to the result
  double overlap = 0;       ///< share of its surfaces on surfaces
                            ///< of other scans, in [0, 1]
  double contradiction = 0; ///< free-space violations / (violations + met surfaces)
  double ambiguity = 0;     ///< score of the second pose / score of the best
  Rejection rejection;      ///< reason of the rejection
};

/** \brief The evidence that a pose needs to be accepted. */
enum class PlaceNeeds {
  kConnected, ///< for a pose found anywhere: confirmed by scans,
              ///< contradicted by no scan and not by all together
  kConfirmed, ///< for a pose predicted by odometry: confirmed by scans, contradicted
              ///< by no scan, and all together do not call it rather wrong than right
  /** as kConfirmed, but each contradicted isolated object counts once (withThingsOnce()): for a
   * pose as near to the prediction as odometry always is */
  kConfirmedAsExpected,
  kNoContradiction ///< contradicted by no scan, even without an observer of the pose
};

/** \brief Knobs of placeByGuesses(). */
struct GuessOptions {
  PlaceNeeds needs = PlaceNeeds::kConnected; ///< of the accepted pose
  double reach = 0;           ///< [m] largest error of the initial poses,
                              ///< besides two cells of plans; >= 0
  double max_ambiguity = 0.6; ///< second score / score of an accepted pose; in [0, 1]
  /** links between correctly registered scans: the usual violations of right poses by dynamic
   * objects, glass and edges; empty: average values */
  std::vector<LinkEvidence> usual;
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Matches (GICP) a scan with other scans from each initial pose, and tests the best
 * poses by the points and rays of the other scans together. For a scan that is near its
 * expected pose.
 * \param[in] others with the same voxel; the most likely neighbours first
 * \param[in] guesses initial poses T_world_scan
 * \return not accepted also without others or guesses
 * \throws BadArgument an invalid option, or a pose is not a rigid motion
 * \note Source: share/doc/place_recognition.md, With a predicted pose
 * \ingroup global_registration */
GuessedPlace
placeByGuesses(const PlaceableScan& scan,
               const std::vector<KnownScan>& others,
               const std::vector<Eigen::Isometry3d>& guesses,
               const GuessOptions& options = {});

/** \brief A quick test, a millisecond per reference scan, before rejectionOfPose().
 * \param[in] others with the same voxel
 * \return free-space violations / (violations + met surfaces), in [0, 1]: 0.001 to 0.01 for
 * right poses, 0.02 to 0.13 for wrong poses (share/doc/place_recognition.md)
 * \throws BadArgument T_world_scan is not a rigid motion */
double
contradictionOfPlace(const PlaceableScan& scan,
                     const std::vector<KnownScan>& others,
                     const Eigen::Isometry3d& T_world_scan);

/** \brief Tests the pose of a scan by the points and rays of other scans.
 * \param[in] others with the same voxel
 * \param[in] usual as GuessOptions::usual
 * \return the reason of the rejection, in words: a scan contradicts the pose, or no scan
 * confirms the pose; empty if accepted
 * \throws BadArgument T_world_scan is not a rigid motion */
Rejection
rejectionOfPose(const PlaceableScan& scan,
                const std::vector<KnownScan>& others,
                const Eigen::Isometry3d& T_world_scan,
                PlaceNeeds needs = PlaceNeeds::kConnected,
                const std::vector<LinkEvidence>& usual = {},
                unsigned int num_threads = 0);

} // namespace pcl6d
