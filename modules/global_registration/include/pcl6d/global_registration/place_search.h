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

/** \brief A candidate for the relative pose of two scans, found without an initial pose. */
struct PlaceCandidate {
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double overlap = 0; ///< share of surfaces that meet, in [0, 1]; floors count little
  double contradiction = 0; ///< share of surfaces violated by rays of the other scan
  double score = 0;         ///< ranks the candidates, in [0, 1]
  LinkEvidence evidence;
  LinkTestResult test_result;
};

/** \brief Result of a search for the relative pose of two scans. */
enum class PlaceAnswer {
  /** one pose, supported by surfaces and rays, with enough overlap and next to no violations.
   * No second pose fits nearly as well, neither elsewhere nor along a motion that the surfaces
   * leave open */
  kUnique,
  kAmbiguous, ///< several poses fit as well: equal rooms, a corridor, a symmetric hall
  kNone       ///< every pose is contradicted by the scans, or has too little overlap
};

/** \return "unique", "ambiguous" or "none" */
const char*
toString(PlaceAnswer answer);

/** \brief Result of placeScan(). */
struct PlaceResult {
  PlaceAnswer answer = PlaceAnswer::kNone;
  std::vector<PlaceCandidate> candidates; ///< the best first; includes
                                          ///< rejected candidates
  Rejection rejection;                    ///< why the answer is not unique

  /** \return second score / score, in [0, 1]; 0 without a second candidate */
  double
  ambiguity() const;
};

/** \brief Knobs of placeScan(). By default, a unique pose is a start for a caller with more
 * scans for a test, such as joinScans(); forTwoScans() is for two scans alone. */
struct PlaceSearchOptions {
  std::size_t candidates = 5; ///< largest number kept; > 0
  double max_ambiguity = 0.6; ///< second score / score of a unique pose; in [0, 1]
  double min_overlap = 0.1;   ///< of a unique pose: share of
                              ///< surfaces that meet; in [0, 1]
  /** of a unique pose: share of surfaces violated by rays of the other scan; in [0, 1]. The
   * link test must accept the pose, too */
  double max_contradiction = 1;
  /** where no pose is unique with the estimated vertical, search also with the alternative
   * verticals of the second scan: its sensor may lie on its side */
  bool any_axis = true;
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result

  /** \brief Options for two scans alone: a unique pose is right, unless parts of the site are
   * equal to the last pillar. Right poses have violations up to 0.01 in static scenes, and to
   * 0.03 among people and in traffic. Folds of a car park, which a parked van gives away, have
   * 0.01 to 0.035, and no pair of scans tells the two apart: hence at most 0.01. Where walls
   * meet by chance without violations, the overlap is up to 0.16: hence at least 0.2 (1700
   * pairs of 12 sets, bench_places). */
  static PlaceSearchOptions
  forTwoScans();

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds the relative pose of two scans without an initial pose.
 *
 * Both scans are turned upright. Plans of their upright surfaces are correlated over every turn
 * and shift; level surfaces give the height. Peaks are tested by some of the points of both
 * scans and by rays. The best poses are matched (GICP) and tested by linkEvidence().
 * \throws BadArgument an invalid option
 * \note Source: share/doc/place_recognition.md
 * \ingroup global_registration */
PlaceResult
placeScan(const PlaceableScan& first,
          const PlaceableScan& second,
          const PlaceSearchOptions& options = {});

/** \brief Matches (GICP) from a given relative pose, for example an initial pose or a chain of
 * links, and tests the result like placeScan().
 * \throws BadArgument T_first_second is not a rigid motion */
PlaceCandidate
evaluatePlace(const PlaceableScan& first,
              const PlaceableScan& second,
              const Eigen::Isometry3d& T_first_second);

/** \brief Matches (GICP) every reduced point of both scans from a pose found by placeScan():
 * accurate to about a twentieth of a voxel, against a third for a candidate.
 * \param[in] num_threads 0: a thread per core; never changes the result
 * \return the given pose if matching fails or leads elsewhere
 * \throws BadArgument T_first_second is not a rigid motion */
Eigen::Isometry3d
refinePlace(const PlaceableScan& first,
            const PlaceableScan& second,
            const Eigen::Isometry3d& T_first_second,
            unsigned int num_threads = 0);

} // namespace pcl6d
