// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where the world of a run lies in that of another one. */
struct RunPlace {
  PlaceAnswer answer = PlaceAnswer::kNone;
  Eigen::Isometry3d T_map_run =
      Eigen::Isometry3d::Identity(); ///< if there is one place
  std::size_t agreeing = 0;          ///< scans whose places say so
  std::size_t tried = 0;             ///< scans that were looked for
  std::string reason; ///< why there is no such place, in words; else empty
};

/** \brief Knobs of placeRun(). */
struct RunPlaceOptions {
  std::size_t tries =
      8; ///< so many scans of the run, evenly, are looked for at most; > 0
  std::size_t enough =
      2; ///< agreeing scans with one sure place: no more are looked for; > 0
  double max_ambiguity = 0.6;   ///< as of MapPlaceOptions
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  ProgressCallback progress =
      {}; ///< told of "placing the run"; may throw, which ends it
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Finds where a run lies in the map of another one, in one piece, by some of its scans:
 * each whose best place in the map (placeInMap()) is clear says where the run lies. Scans that
 * were taken in different places and say the same are hardly deceived, as by equal rooms: the
 * run is where most of them say, within six voxels and 3 deg, and nowhere if as many say
 * otherwise. Where something speaks against their places, as things do that have changed, one
 * more has to agree. A quick way for runs that are to be compared; joinScans() asks all scans.
 * \param[in] run, map with the same voxel, at least one of each; poses in their own worlds
 * \throws BadArgument an option breaks its rule, a run is empty, or a pose is not a rigid
 * motion \ingroup global_registration */
RunPlace
placeRun(const std::vector<KnownScan>& run,
         const std::vector<KnownScan>& map,
         const RunPlaceOptions& options = {});

} // namespace pcl6d
