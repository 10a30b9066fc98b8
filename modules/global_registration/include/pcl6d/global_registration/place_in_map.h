// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A candidate pose of a scan in a map, tested by the scans of the map together. */
struct MapPlace {
  Eigen::Isometry3d T_map_scan = Eigen::Isometry3d::Identity();
  double overlap = 0;       ///< share of its surfaces on surfaces of the map, in [0, 1]
  double contradiction = 0; ///< free-space violations / (violations + met surfaces)
  double score = 0;         ///< ranks the candidates, in [0, 1]
  /** links with the map scans of most overlap: `from` is an index in the map, `to` the number
   * of map scans; empty where the overlap is too small */
  std::vector<LinkCheck> links;
  Rejection rejection; ///< reason of the rejection
};

/** \brief Where in a map a scan was taken. */
struct MapPlaces {
  PlaceAnswer answer = PlaceAnswer::kNone;
  std::vector<MapPlace> candidates; ///< the best first; includes rejected candidates
  Rejection rejection;              ///< reason if not unique
  std::size_t pairs_compared = 0, pairs_placed = 0;

  /** \return second score / score, in [0, 1]; 0 without a second candidate */
  double
  ambiguity() const;
};

/** \brief Knobs of placeInMap(). */
struct MapPlaceOptions {
  std::size_t pairs = 8; ///< number of map scans, the likeliest, for placeScan(); > 0
  std::size_t candidates = 5;   ///< largest number kept; > 0
  double max_ambiguity = 0.6;   ///< second score / score of a unique pose; in [0, 1]
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** "comparing" and "placing"; may throw to stop the search */
  ProgressCallback progress = {};
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds the pose of a scan in a map without an initial pose.
 *
 * A quick comparison (10 ms per map scan) ranks the scans of the map, and placeScan() registers
 * the scan with the likeliest. The candidates are matched with every overlapping scan of the
 * map, and tested by the points and rays of these scans, as in joinScans().
 * \param[in] map with the same voxel, at least one scan; its poses stay fixed
 * \throws BadArgument an invalid option, the map is empty, or a pose is not a rigid motion
 * \note Source: share/doc/place_recognition.md, Joint placement
 * \ingroup global_registration */
MapPlaces
placeInMap(const PlaceableScan& scan,
           const std::vector<KnownScan>& map,
           const MapPlaceOptions& options = {});

} // namespace pcl6d
