// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/global_registration/placeable_scan.h>
#include <pcl6d/verification/link_evidence.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan whose pose is known, by which others are placed. */
struct KnownScan {
  const PlaceableScan* scan = nullptr;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief The best place of a scan that was found from guesses. */
struct GuessedPlace {
  bool accepted = false;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  std::size_t guess = 0; ///< place of the guess that it was found from
  double overlap = 0;    ///< share of its surfaces that meet others, in [0, 1]
  double contradiction =
      0;                ///< of these and those that others looked through, the latter
  double ambiguity = 0; ///< score of the second place / that of the best
  std::string reason;   ///< why it is not accepted, in words; else empty
};

/** \brief What a place needs not to be objected to. */
enum class PlaceNeeds {
  kToBeTied, ///< others that say that it is right, none, and not all together, against it:
             ///< of a place found anywhere
  kToBeHeld, ///< others that say that it is right, and none that contradicts it: of a place
             ///< to which odometry leads
  kToBeHeldAsExpected, ///< the same, but contradicted things that stand alone count once
  ///< (withThingsOnce()): of a place that is as near to where it was
  ///< expected as odometry always is
  kNoObjection ///< none that contradicts it, also where nobody sees it
};

/** \brief Knobs of placeByGuesses(). */
struct GuessOptions {
  PlaceNeeds needs = PlaceNeeds::kToBeTied; ///< of the place that is accepted
  double reach =
      0; ///< [m] by which guesses may be off, besides two cells of plans; >= 0
  double max_ambiguity =
      0.6; ///< second score / score of a place that counts; in [0, 1]
  /** links between scans that lie where they belong, which tell how much right places are
   * contradicted by things that move, glass and edges; empty: as on average */
  std::vector<LinkEvidence> usual;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Matches (GICP) a scan with others from each guess, and judges the best places by
 * the points and rays of all others together: for a scan that is not where it was expected,
 * but near it.
 * \param[in] others with the same voxel; the most likely neighbours first
 * \param[in] guesses of T_world_scan
 * \return not accepted also without others or guesses
 * \throws BadArgument an option breaks its rule, or a pose is not a rigid motion
 * \note Source: algorithms.md G.3 \ingroup global_registration */
GuessedPlace
placeByGuesses(const PlaceableScan& scan,
               const std::vector<KnownScan>& others,
               const std::vector<Eigen::Isometry3d>& guesses,
               const GuessOptions& options = {});

/** \brief A quick look, of a millisecond for each of the others, before objectionToPlace().
 * \param[in] others with the same voxel
 * \return of the surfaces that meet others and those that others looked through, the latter, in
 * [0, 1]: 0.001 to 0.01 of right places, 0.02 to 0.13 of wrong ones (algorithms.md G.4)
 * \throws BadArgument T_world_scan is not a rigid motion */
double
contradictionOfPlace(const PlaceableScan& scan,
                     const std::vector<KnownScan>& others,
                     const Eigen::Isometry3d& T_world_scan);

/** \brief Asks others whether a scan is where it is said to be, by their points and rays.
 * \param[in] others with the same voxel
 * \param[in] usual as GuessOptions::usual
 * \return why not, in words: one contradicts it, or none holds it; empty if nothing is against
 * it
 * \throws BadArgument T_world_scan is not a rigid motion */
std::string
objectionToPlace(const PlaceableScan& scan,
                 const std::vector<KnownScan>& others,
                 const Eigen::Isometry3d& T_world_scan,
                 PlaceNeeds needs = PlaceNeeds::kToBeTied,
                 const std::vector<LinkEvidence>& usual = {},
                 unsigned int num_threads = 0);

} // namespace pcl6d
