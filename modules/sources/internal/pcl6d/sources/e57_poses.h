// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Copies an E57 file with new poses of the scans, atomically.
 *
 * Only the `pose` elements of the scans change, and the checksums of their pages: points,
 * images (with separate poses), names and extensions stay byte for byte. If an element is too
 * short for the new pose, the XML section grows; the section then continues behind the end of
 * the file or, if further sections follow, moves there as a whole, and the header is updated.
 *
 * \param[in] from a file readable by E57Source \param[in] to may equal `from`
 * \param[in] poses T_world_scan for each scan of the file; empty: unchanged
 * \throws IoFailed the file cannot be read, or the result not be written
 * \throws BadArgument another number of poses \ingroup sources */
void
writeE57Poses(const std::filesystem::path& from,
              const std::filesystem::path& to,
              const std::vector<std::optional<Eigen::Isometry3d>>& poses);

} // namespace pcl6d
