// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <filesystem>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Describes a projected coordinate system for files of surveys.
 * \param[in] code of the EPSG registry, for example 25832 (ETRS89 / UTM zone 32N); also of a
 * projected system with heights
 * \return well-known text for LAS 1.4 and E57 (OGC 01-009; ISO 19162 for newer systems)
 * \throws BadArgument unknown code, not a projected system, or a unit other than the metre
 * \ingroup sources */
std::string
wktOfEpsg(int code);

/** \return the coordinate system of a file in well-known text, or empty. Supports LAS, LAZ and
 * E57; empty for further formats \throws IoFailed the file cannot be read */
std::string
coordinateSystemOf(const std::filesystem::path& file);

/** \return the name in well-known text: "ETRS89 / UTM zone 32N"; without a name the text itself */
std::string
nameOfWkt(const std::string& wkt);

} // namespace pcl6d
