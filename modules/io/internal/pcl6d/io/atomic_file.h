// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes a file atomically: a reader sees the old or the new content, even after a power
 * cut. The content goes to an unnamed file, is flushed to the disk and then replaces the path.
 * On a file system without unnamed files, a new hidden file with a random name in the same
 * folder is used. No temporary file stays behind. The file gets the permissions of an ordinary
 * new file, or of the replaced file. A link stays a link, and the target of the link is
 * replaced. A device, a pipe, or a file already open in this process, such as /dev/stdout, is
 * written directly and keeps its previous content.
 * \param[in] path an existing file is replaced
 * \param[in] write puts the content into the (binary) stream; seeking back is possible in a
 * file (isStream() tells), not in a pipe
 * \throws IoFailed the folder is missing or not writable, the path is a link made by another
 * user (except root), the disk is full, or a file size limit is exceeded (reported only by a
 * program that ignores SIGXFSZ)
 * \ingroup io */
void
writeFileAtomically(const std::filesystem::path& path,
                    const std::function<void(std::ostream&)>& write);

/** \brief writeFileAtomically() for content that a library writes by file name.
 * \param[in] write gets a path in a private folder, with the extension of path */
void
writeFileAtomicallyBy(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/** \return whether a path names a device, a pipe or a file already open in this process, such as
 * /dev/stdout; no second file can be put beside such a path
 * \throws IoFailed under the conditions of requireWritable() \ingroup io */
bool
isStream(const std::filesystem::path& path);

/** \brief Checks, before the work, whether the result can be written; changes no file.
 * \param[in] path as for writeFileAtomically(); devices and pipes are not checked
 * \throws IoFailed the path is not a file name, or the folder is missing or not writable
 * \ingroup io */
void
requireWritable(const std::filesystem::path& path);

} // namespace pcl6d
