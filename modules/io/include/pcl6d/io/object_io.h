// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>

#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes objects as JSON (fields: share/doc/run_folder.md), atomically; the id
 * of an object is its place plus one. \throws IoFailed the file cannot be written
 * \ingroup io */
void
writeObjects(const std::filesystem::path& path, const std::vector<ObjectPose>& objects);

/** \brief Reads what writeObjects() wrote, or a list of found objects: `moves` and `points`
 * may be missing, further fields are left out. \throws IoFailed the file cannot be read or
 * is no such JSON; the message names the object and the field \ingroup io */
std::vector<ObjectPose>
readObjects(const std::filesystem::path& path);

} // namespace pcl6d
