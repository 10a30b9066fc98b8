// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads which scans are linked: the edges of a pose graph (g2o or TORO, known by
 * its first word) by the ids of its vertices, or lines `a b` with the indices of two scans
 * of a folder, whole numbers. Empty lines and
 * those that start with # are skipped; what follows two numbers in a line is, too.
 * \return the pairs in the order of the file
 * \throws IoFailed unreadable; a line that is none, or links a scan to itself; as
 * readPoseGraph() \ingroup io */
std::vector<std::pair<std::size_t, std::size_t>>
readLinkList(const std::filesystem::path& path);

} // namespace pcl6d
