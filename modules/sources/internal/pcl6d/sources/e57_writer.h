// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_reader.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan with its pose, to be written to an E57 file. */
struct E57Station {
  std::string name;
  std::optional<Eigen::Isometry3d> pose; ///< T_world_scan; empty: no pose is written
  std::optional<double> stamp;           ///< [s], start of the recording in GPS time
  ScanCloud scan; ///< rows of the cloud become the grid of the file
};

/** \brief Writes an E57 file (ASTM E2807) with a scan for each station, atomically.
 *
 * Coordinates keep the type, float or double; non-finite points are marked as invalid.
 * intensity keeps all bits, and its limits are written; rgb and rgba become 8-bit colours,
 * normals are written with the extension "nor"; time, row, column, return_index and
 * return_count keep the numbers. For rows read with points left out (ScanCloud::places), and
 * for organized clouds, each point gets its row and column.
 *
 * \param[in] count number of stations
 * \param[in] station called once for each number, in order; a single scan is in memory at a
 * time
 * \param[in] coordinate_system of the poses, in well-known text (wktOfEpsg()), or empty
 * \return for each station the losses, such as "dropped field 'ring'"
 * \throws IoFailed the file cannot be written
 * \throws BadArgument a cloud has no x, y, z of floating point, or fields and data do not fit
 * together \ingroup sources */
std::vector<std::vector<std::string>>
writeE57(const std::filesystem::path& path,
         std::size_t count,
         const std::function<E57Station(std::size_t)>& station,
         const std::string& coordinate_system = {});

} // namespace pcl6d
