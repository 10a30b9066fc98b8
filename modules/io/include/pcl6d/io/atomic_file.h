// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes a file so that a reader sees all of it or nothing: the content goes to
 * a temporary name in the same folder, which is then renamed. Whatever happens, no
 * temporary file stays behind. \param[in] path an existing file there is replaced
 * \param[in] write puts the content into the (binary) stream
 * \throws IoFailed the folder is missing or not writable, or the disk is full
 * \ingroup io */
void
writeFileAtomically(const std::filesystem::path& path,
                    const std::function<void(std::ostream&)>& write);

/** \brief The same for content that a library writes by file name itself.
 * \param[in] write gets the temporary path, which has the extension of path */
void
writeFileAtomicallyBy(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

} // namespace pcl6d
