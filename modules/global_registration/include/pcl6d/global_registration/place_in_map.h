// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A place of a scan in a map, by all of the map's scans together. */
struct MapPlace {
  Eigen::Isometry3d T_map_scan = Eigen::Isometry3d::Identity();
  double overlap = 0; ///< share of its surfaces that meet the map's, in [0, 1]
  double contradiction =
      0;            ///< of these and those that the map looked through, the latter
  double score = 0; ///< by which places are ranked, in [0, 1]
  /** with the scans of the map that it meets most: from is a place in the map, to the number
   * of the map's scans; none where too little meets */
  std::vector<LinkCheck> links;
  std::string objection; ///< what speaks against it, in words; else empty
};

/** \brief Where in a map a scan was taken. */
struct MapPlaces {
  PlaceAnswer answer = PlaceAnswer::kNone;
  std::vector<MapPlace> candidates; ///< the best first; also those not accepted
  std::string reason;               ///< why it is not unique, in words; else empty
  std::size_t pairs_compared = 0, pairs_placed = 0;

  /** \return second score / score, in [0, 1]; 0 if there is no second one */
  double
  ambiguity() const;
};

/** \brief Knobs of placeInMap(). */
struct MapPlaceOptions {
  std::size_t pairs =
      8; ///< on so many scans of the map, the likeliest, it is placed; > 0
  std::size_t candidates = 5;   ///< so many are kept; > 0
  double max_ambiguity = 0.6;   ///< second score / score of a unique place; in [0, 1]
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  /** told of "comparing" and "placing"; may throw, which ends it */
  ProgressCallback progress = {};
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Finds the place of a scan in a map without a guess.
 *
 * The scan is compared quickly with all scans of the map (10 ms each), and placed on the
 * likeliest ones (placeScan()). Its candidates are matched with all scans that they meet, and
 * judged by the points and rays of these, as joinScans() judges scans that join a group.
 * \param[in] map with the same voxel, at least one; its own scans keep their places
 * \throws BadArgument an option breaks its rule, the map is empty, or a pose is not a rigid
 * motion
 * \note Source: algorithms.md G.2 to G.4 \ingroup global_registration */
MapPlaces
placeInMap(const PlaceableScan& scan,
           const std::vector<KnownScan>& map,
           const MapPlaceOptions& options = {});

} // namespace pcl6d
