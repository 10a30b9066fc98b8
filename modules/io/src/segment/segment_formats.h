// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/segment.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file The formats of readSegments(), in the units of the file. */
namespace pcl6d::io {

/** \brief Appends the sides of a polygon line, optionally including the closing side. */
void
appendLine(const std::vector<Eigen::Vector2d>& line, bool closed, Segments& segments);

/** Each reads the content of a file. \param[in] path for messages
 * \throws IoFailed naming file, position, value and rule */
Segments
segmentsOfCsv(const std::string& content, const std::filesystem::path& path);
Segments
segmentsOfGeoJson(const std::string& content, const std::filesystem::path& path);
Segments
segmentsOfSvg(const std::string& content, const std::filesystem::path& path);

} // namespace pcl6d::io
