// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a list of links between scans: the edges of a pose graph (g2o or TORO,
 * recognised by the first word) by vertex ids, or lines `a b` with the indices of two scans of
 * a folder, whole numbers. Empty lines, lines that start with # and text after the two numbers
 * of a line are skipped.
 * \return the pairs in the order of the file
 * \throws IoFailed unreadable; an invalid line, or a link from a scan to itself; the errors of
 * readPoseGraph() \ingroup io */
std::vector<std::pair<std::size_t, std::size_t>>
readLinkList(const std::filesystem::path& path);

} // namespace pcl6d
