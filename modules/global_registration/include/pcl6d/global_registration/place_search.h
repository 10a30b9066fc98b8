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

/** \brief A place of a scan relative to another that was found without a guess. */
struct PlaceCandidate {
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double overlap = 0; ///< share of surfaces that meet, in [0, 1]; floors count little
  double contradiction = 0; ///< of surfaces, those the other scan looked through
  double score = 0;         ///< by which candidates are ranked, in [0, 1]
  LinkEvidence evidence;
  LinkOpinion opinion;
};

/** \brief Whether a scan has a place on another. */
enum class PlaceAnswer {
  /** one place, good by surfaces and rays, where enough meets and next to nothing
   * contradicts, and no other nearly as good: neither elsewhere nor along a motion that the
   * surfaces leave open */
  kUnique,
  kAmbiguous, ///< several are as good: equal rooms, a corridor, a symmetric hall
  kNone       ///< no place that the scans do not contradict, or too little that meets
};

/** \return "unique", "ambiguous" or "none" */
const char*
toString(PlaceAnswer answer);

/** \brief What placeScan() found. */
struct PlaceResult {
  PlaceAnswer answer = PlaceAnswer::kNone;
  std::vector<PlaceCandidate> candidates; ///< the best first; also those not accepted
  std::string reason;                     ///< in words, for people

  /** \return second score / score, in [0, 1]; 0 if there is no second one */
  double
  ambiguity() const;
};

/** \brief Knobs of placeScan(). As they are, a unique place is a start for who has more scans
 * to ask, as joinScans() does; forTwoScans() is for who has not. */
struct PlaceSearchOptions {
  std::size_t candidates = 5; ///< so many are kept; > 0
  double max_ambiguity = 0.6; ///< second score / score of a unique place; in [0, 1]
  double min_overlap =
      0.1; ///< of a unique place: share of surfaces that meet; in [0, 1]
  /** of a unique place: share of surfaces that the other scan looked through; in [0, 1]. Also
   * the opinion on the place must be good */
  double max_contradiction = 1;
  /** where no place is unique with up as it seems, also looks for places with the other
   * directions that may be up in the second scan, as if its sensor lay on its side */
  bool any_axis = true;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result

  /** \brief Those for two scans alone: what is unique by them is right, unless parts of the
   * site are equal to the last pillar. Right places have contradictions up to 0.01 where
   * nothing moves, to 0.03 among people and in traffic; folds of a car park, which a parked
   * van gives away, have 0.01 to 0.035, and no pair of scans tells the two apart: so 0.01 is
   * the most. Where walls meet by chance and nothing contradicts, the overlap is up to 0.16:
   * so 0.2 is the least (1700 pairs of 12 sets, bench_places). */
  static PlaceSearchOptions
  forTwoScans();

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Finds the place of a scan on another without a guess.
 *
 * Both are turned upright. Plans of their upright surfaces are laid over each other in all
 * turns and shifts; level surfaces tell the height. What stands out is judged by some of the
 * points of both and by rays; the best places are matched (GICP) and judged by
 * linkEvidence().
 * \throws BadArgument an option breaks its rule
 * \note Source: algorithms.md G.1, G.4 \ingroup global_registration */
PlaceResult
placeScan(const PlaceableScan& first,
          const PlaceableScan& second,
          const PlaceSearchOptions& options = {});

/** \brief Matches (GICP) from a place that comes from elsewhere, and judges it as those of
 * placeScan(): of a guess, or by way of other scans.
 * \throws BadArgument T_first_second is not a rigid motion */
PlaceCandidate
judgePlace(const PlaceableScan& first,
           const PlaceableScan& second,
           const Eigen::Isometry3d& T_first_second);

/** \brief Matches (GICP) all reduced points of both scans from a place that placeScan() found:
 * within a twentieth of a voxel or so, where that of a candidate is within a third.
 * \param[in] num_threads 0: one per core; never changes the result
 * \return the place itself if matching fails or leads elsewhere
 * \throws BadArgument T_first_second is not a rigid motion */
Eigen::Isometry3d
refinePlace(const PlaceableScan& first,
            const PlaceableScan& second,
            const Eigen::Isometry3d& T_first_second,
            unsigned int num_threads = 0);

} // namespace pcl6d
