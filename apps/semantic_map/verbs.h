// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/verbs.h"

#include <filesystem>
#include <string>

namespace pcl6d::app {

constexpr const char* kSemanticMap = "pcl_slam6d_semantic_map"; ///< the program's name
constexpr const char* kMapFile = "semantic_map.json"; ///< in the folder of a run

/** \file The verbs; their descriptions are in the table of
 * pcl_slam6d_semantic_map.cpp. */
int
runMapBuild(const Arguments& arguments);
int
runMapQuery(const Arguments& arguments);
int
runMapInfo(const Arguments& arguments);

/** \return the file of a map: the argument, or kMapFile in it for a folder */
inline std::filesystem::path
mapFile(const std::string& argument)
{
  std::error_code missing;
  return std::filesystem::is_directory(argument, missing)
             ? std::filesystem::path(argument) / kMapFile
             : std::filesystem::path(argument);
}

} // namespace pcl6d::app
