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
  kUnique,    ///< one place, good by surfaces and rays, and no other nearly as good
  kAmbiguous, ///< several are as good: equal rooms, a corridor, a symmetric hall
  kNone       ///< no place that the scans do not contradict
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

/** \brief Knobs of placeScan(). */
struct PlaceSearchOptions {
  std::size_t candidates = 5; ///< so many are kept; > 0
  double max_ambiguity = 0.6; ///< second score / score of a unique place; in [0, 1]
  /** where no place is unique with up as it seems, also looks for places with the other
   * directions that may be up in the second scan, as if its sensor lay on its side */
  bool any_axis = true;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
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

} // namespace pcl6d
