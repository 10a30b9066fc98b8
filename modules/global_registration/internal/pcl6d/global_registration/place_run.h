// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/global_registration/place_search.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Pose of one run in the map of another run. */
struct RunPlace {
  PlaceAnswer answer = PlaceAnswer::kNone;
  Eigen::Isometry3d T_map_run = Eigen::Isometry3d::Identity(); ///< valid if unique
  std::size_t agreeing = 0; ///< scans whose poses agree with T_map_run
  std::size_t tried = 0;    ///< scans searched in the map
  Rejection rejection;      ///< reason if no pose was found
};

/** \brief Knobs of placeRun(). */
struct RunPlaceOptions {
  std::size_t tries = 8;          ///< largest number of scans of the run,
                                  ///< evenly spaced, to search for; > 0
  std::size_t enough = 2;         ///< agreeing scans with a unique
                                  ///< pose that end the search; > 0
  double max_ambiguity = 0.6;     ///< as of MapPlaceOptions
  unsigned int num_threads = 0;   ///< 0: a thread per core; never changes the result
  ProgressCallback progress = {}; ///< "placing the run"; may throw to stop the search
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds the pose of a run, as one rigid piece, in the map of another run, from a few of
 * its scans. Each scan whose best pose in the map (placeInMap()) is clear votes for a pose of
 * the run. Scans from different positions that agree are hardly misled by equal rooms. The
 * pose with most votes wins, within six voxels and 3 deg; a tie gives no pose. Where a
 * contradiction remains, as with changed objects, one more vote is needed. A quick method for
 * runs that are to be compared; joinScans() uses every scan.
 * \param[in] run, map with the same voxel, at least one scan each; poses in their own worlds
 * \throws BadArgument an invalid option, a run is empty, or a pose is not a rigid motion
 * \ingroup global_registration */
RunPlace
placeRun(const std::vector<KnownScan>& run,
         const std::vector<KnownScan>& map,
         const RunPlaceOptions& options = {});

} // namespace pcl6d
