// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a text file of lines `x y z`, for example the waypoints of a robot [m], in
 * double; empty lines and lines that begin with # are skipped.
 * \throws IoFailed naming file, line, value and rule \ingroup io */
std::vector<Eigen::Vector3d>
readPointList(const std::filesystem::path& path);

} // namespace pcl6d
