// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/plane.h>

#include <filesystem>
#include <vector>

namespace pcl6d {

/** \brief Writes planes as JSON (fields: share/doc/run_folder.md), atomically; the id of
 * a plane is its place plus one. \throws IoFailed the file cannot be written
 * \ingroup io */
void
writePlanes(const std::filesystem::path& path, const std::vector<Plane>& planes);

} // namespace pcl6d
