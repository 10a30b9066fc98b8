// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Origin of planes. */
struct PlaneOrigin {
  std::optional<double> seconds; ///< computing time for the detection
  std::string generator;         ///< the program; empty: not said
};

/** \brief Writes planes as JSON (fields: share/doc/run_folder.md), atomically; the id of a plane
 * is its index plus one. Unset fields of the origin are left out.
 * \throws IoFailed the file cannot be written \ingroup io */
void
writePlanes(const std::filesystem::path& path,
            const std::vector<Plane>& planes,
            const PlaneOrigin& origin = {});

/** \brief Reads the file of writePlanes(); a missing `rms` becomes 0.
 * \throws IoFailed the file cannot be read or has another structure; the message names the
 * plane and the field */
std::vector<Plane>
readPlanes(const std::filesystem::path& path);

} // namespace pcl6d
