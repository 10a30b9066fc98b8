// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/rejection.h>
#include <pcl6d/global_registration/place_in_map.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Pose of a further scan in a finished map. */
struct LocalisedScan {
  PlaceAnswer answer = PlaceAnswer::kNone; ///< the pose counts only if unique
  /** best candidate; the prediction, or identity, without a candidate */
  Eigen::Isometry3d T_map_scan = Eigen::Isometry3d::Identity();
  bool tracked = false; ///< found near the prediction; false: searched in the whole map
  double overlap =
      0; ///< share of the scan's surfaces on surfaces of the map, in [0, 1]
  double contradiction = 0; ///< share of surfaces seen through by rays, in [0, 1]
  Rejection rejection;      ///< why the answer is not unique
};

/** \brief Knobs of MapLocaliser. */
struct MapLocaliserOptions {
  std::size_t neighbours = 8;   ///< scans of the map compared with a tracked scan; > 0
  MapPlaceOptions search = {};  ///< in the whole map
  unsigned int num_threads = 0; ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Finds further scans in a finished map, scan after scan, without changing the map.
 *
 * A scan is matched near the prediction first: the previous pose, moved by the given motion or
 * else by the last motion, or not moved at all. Points and rays of the nearest scans of the map
 * decide. Without a previous pose, or where the prediction fails, the scan is searched in the
 * whole map (placeInMap()).
 * \code
 * pcl6d::MapLocaliser localiser(map); // KnownScan per scan of the map
 * const pcl6d::LocalisedScan found = localiser.localise(scan);
 * \endcode
 * \note Source: share/doc/place_recognition.md \ingroup global_registration */
class MapLocaliser {
public:
  /** \param[in] map scans with poses, of equal voxel; kept by reference
   * \throws BadArgument an invalid option, or the map is empty */
  explicit MapLocaliser(std::vector<KnownScan> map,
                        const MapLocaliserOptions& options = {});

  /** \param[in] scan prepared with the voxel of the map
   * \param[in] motion T_before_scan from odometry [m]; default: constant velocity
   * \param[in] left_out indices of map scans not compared with the scan
   * \throws BadArgument the motion is not rigid, or every scan of the map is left out */
  LocalisedScan
  localise(const PlaceableScan& scan,
           const std::optional<Eigen::Isometry3d>& motion = {},
           const std::set<std::size_t>& left_out = {});

private:
  std::optional<LocalisedScan>
  track(const PlaceableScan& scan,
        const std::optional<Eigen::Isometry3d>& motion,
        const std::vector<KnownScan>& map) const;
  LocalisedScan
  search(const PlaceableScan& scan, const std::vector<KnownScan>& map) const;

  std::vector<KnownScan> map_;
  MapLocaliserOptions options_;
  std::optional<Eigen::Isometry3d> before_; ///< pose of the last scan, if unique
  Eigen::Isometry3d motion_ = Eigen::Isometry3d::Identity(); ///< last T_before_scan
};

} // namespace pcl6d
