// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/object_pose.h>

#include <filesystem>
#include <vector>

namespace pcl6d {

/** \brief Writes objects as JSON (fields: share/doc/run_folder.md), atomically; the id
 * of an object is its place plus one. \throws IoFailed the file cannot be written
 * \ingroup io */
void
writeObjects(const std::filesystem::path& path, const std::vector<ObjectPose>& objects);

} // namespace pcl6d
