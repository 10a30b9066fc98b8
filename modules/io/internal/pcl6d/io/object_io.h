// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class JsonValue;

/** \brief Writes objects as JSON (fields: share/doc/run_folder.md), atomically; the id of an
 * object is its index plus one. \throws IoFailed the file cannot be written
 * \ingroup io */
void
writeObjects(const std::filesystem::path& path, const std::vector<ObjectPose>& objects);

/** \brief The box of an object in the object's frame [m], by the corners `box_min` and
 * `box_max`, which keep all bits, or by `extent` and an optional `centre`, default 0.
 * \return the box, or empty if both pairs are missing \throws IoFailed a corner or a side is no
 * three numbers, or the box is inside out; the message names the field \ingroup io */
std::optional<Eigen::AlignedBox3d>
boxOf(const JsonValue& object);

/** \brief Reads the file of writeObjects(), or a list of found objects: boxes as in boxOf(),
 * `moves` and `points` may be missing, further fields are ignored.
 * \throws IoFailed the file cannot be read or has another structure, a pose is not rigid or a
 * box is missing; the message names the object and the field \ingroup io */
std::vector<ObjectPose>
readObjects(const std::filesystem::path& path);

} // namespace pcl6d
