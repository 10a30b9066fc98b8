// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace pcl6d::faults {

/** \brief Makes small valid inputs of all kinds, most of them with the suite's own programs:
 * scans in all formats, a finished run, planes, objects, meshes, plans, pictures, graphs.
 * \param[in] programs their folder
 * \param[in] share the folder share/ of the sources
 * \param[in] folder a new one, which gets them
 * \throws std::runtime_error a program did not make one, in its words */
void
makeSamples(const std::filesystem::path& programs,
            const std::filesystem::path& share,
            const std::filesystem::path& folder);

/** \brief Writes depth images, two pictures of a wall and pictures of a chessboard. */
void
writePictures(const std::filesystem::path& folder);

} // namespace pcl6d::faults
