// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.h"
#include "options.h"

#include <pcl6d/io/scan_folder.h>

#include <filesystem>
#include <vector>

namespace pcl6d::python {

/** \return a path from a str or os.PathLike \throws BadArgument another type */
std::filesystem::path
pathOf(const py::object& value, const std::string& name);

/** \brief Selection of scans by the options format, poses, first, last, every. */
ScanFolderOptions
folderOptions(Options& options);

/** \return values of a field of the points, or None */
py::object
fieldOrNone(const pcl::PCLPointCloud2& cloud, const char* name);

} // namespace pcl6d::python
