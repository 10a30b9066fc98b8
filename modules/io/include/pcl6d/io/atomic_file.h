// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes a file so that a reader sees all of it or nothing, after a power cut too:
 * the content goes to a file without a name (where the file system knows none: with a
 * random hidden name in the same folder, opened only if it is new), is brought to the disk
 * and then takes the place of the path. Whatever happens, nothing else stays behind. The
 * file has the permissions that an ordinary one gets, or those of the file it replaces. A
 * link stays a link, and what it names is replaced. A device or a pipe is written as it is,
 * and so is a file that this process has open, such as /dev/stdout: what it holds stays.
 * \param[in] path an existing file there is replaced
 * \param[in] write puts the content into the (binary) stream; it cannot go back in it
 * \throws IoFailed the folder is missing or not writable, the path is a link that another
 * user (but root) has made, the disk is full, or the process may not write so much (a
 * program that wants words for this ignores SIGXFSZ)
 * \ingroup io */
void
writeFileAtomically(const std::filesystem::path& path,
                    const std::function<void(std::ostream&)>& write);

/** \brief The same for content that a library writes by file name itself.
 * \param[in] write gets a path in a folder that nobody else can enter, with the extension
 * of path */
void
writeFileAtomicallyBy(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/** \return whether what is written to a path goes to a device, a pipe or a file that this
 * process has open, such as /dev/stdout, and nothing can be put beside it
 * \throws IoFailed as requireWritable() \ingroup io */
bool
isStream(const std::filesystem::path& path);

/** \brief Tries, before the work, whether its result can be written; nothing is changed.
 * \param[in] path as for writeFileAtomically(); of a device or a pipe nothing is known
 * \throws IoFailed it names no file, or the folder is missing or not writable
 * \ingroup io */
void
requireWritable(const std::filesystem::path& path);

} // namespace pcl6d
