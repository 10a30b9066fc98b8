// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/object_localization/object_finder.h>
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

/** \file Observations of objects in the scans of a map. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Objects observed in one scan. */
struct ScanObjects {
  std::filesystem::path file;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  std::vector<std::size_t> observations; ///< indices into
                                         ///< ObjectObservations::observations
  /** per observation its points, as indices into the file */
  std::vector<std::vector<std::uint32_t>> points;
};

/** \brief Objects observed in several scans. */
struct ObjectObservations {
  std::vector<MapObject> observations;
  std::vector<ScanObjects> scans;
  double seconds = 0; ///< of the search, without reading
};

/** \brief The range gate of a scan [m]. */
struct ObservationRange {
  double min_range = 0;
  double max_range = std::numeric_limits<double>::infinity();
};

/** \brief Searches a scan for objects and adds them in the world frame.
 * \param[in] file for messages and ScanObjects
 * \param[in] id of the scan in the map
 * \throws BadArgument naming the file: fewer than 10 points \ingroup semantic_map */
void
observeObjects(const ObjectFinder& finder,
               const Scan& scan,
               const std::filesystem::path& file,
               const Eigen::Isometry3d& T_world_scan,
               std::size_t id,
               const ObservationRange& range,
               ObjectObservations& found);

/** \brief Searches the scans of a folder or a run for objects, one by one.
 * \param[in] given range; a limit of 0 is replaced by the run's limit
 * \param[in] progress called with each scan ("scans"); its exceptions pass through
 * \throws IoFailed a scan cannot be read \throws BadArgument see above */
ObjectObservations
observeObjects(const ObjectFinder& finder,
               const RegisteredScans& scans,
               const ObservationRange& given = {0, 0},
               const ProgressCallback& progress = {});

} // namespace pcl6d
