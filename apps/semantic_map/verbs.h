// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kSemanticMap = "pcl_slam6d_semantic_map"; ///< the program's name
constexpr const char* kMapFile = "semantic_map.json"; ///< in the folder of a run

/** \brief `build RUN_DIR`: the semantic map of a finished run.
 * \param[in] arguments after the verb \return the exit code */
int
runMapBuild(const std::vector<std::string>& arguments);

/** \brief `query MAP "..."`: what of a map meets conditions.
 * \param[in] arguments after the verb \return the exit code */
int
runMapQuery(const std::vector<std::string>& arguments);

/** \brief `info MAP`: what a map holds.
 * \param[in] arguments after the verb \return the exit code */
int
runMapInfo(const std::vector<std::string>& arguments);

/** \return the file of a map: the argument, or kMapFile in it if it is a folder */
inline std::filesystem::path
mapFile(const std::string& argument)
{
  std::error_code missing;
  return std::filesystem::is_directory(argument, missing)
             ? std::filesystem::path(argument) / kMapFile
             : std::filesystem::path(argument);
}

} // namespace pcl6d::app
