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

/** \file What the scans of a map show of objects. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief What one scan shows. */
struct ScanObjects {
  std::filesystem::path file;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  std::vector<std::size_t> observations; ///< places in the list of all
  /** per observation its points, as places in the file */
  std::vector<std::vector<std::uint32_t>> points;
};

/** \brief What several scans show. */
struct ObjectObservations {
  std::vector<MapObject> observations;
  std::vector<ScanObjects> scans;
  double seconds = 0; ///< of the search, without reading
};

/** \brief The ranges [m] in which a scan is looked at. */
struct ObservationRange {
  double min_range = 0;
  double max_range = std::numeric_limits<double>::infinity();
};

/** \brief Looks for objects in a scan and adds what it finds, in the world.
 * \param[in] file for messages and ScanObjects \param[in] id of the scan in the map
 * \throws BadArgument naming the file: fewer than 10 points \ingroup semantic_map */
void
observeObjects(const ObjectFinder& finder,
               const Scan& scan,
               const std::filesystem::path& file,
               const Eigen::Isometry3d& T_world_scan,
               std::size_t id,
               const ObservationRange& range,
               ObjectObservations& found);

/** \brief Looks for objects in the scans of a folder or a run, one after the other.
 * \param[in] given range; a limit that is 0 is that of the run
 * \param[in] progress called with each scan ("scans"); what it throws goes through
 * \throws IoFailed a scan cannot be read \throws BadArgument as above */
ObjectObservations
observeObjects(const ObjectFinder& finder,
               const RegisteredScans& scans,
               const ObservationRange& given = {0, 0},
               const ProgressCallback& progress = {});

} // namespace pcl6d
