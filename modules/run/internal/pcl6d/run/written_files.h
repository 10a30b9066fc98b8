// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <filesystem>
#include <map>
#include <string>

/** \file Sizes and checksums of a run's files, by which a reader detects files of another run. */
namespace PCL6D_EXPORTS pcl6d {

/** \return size and checksum of a file \throws IoFailed the file cannot be read \ingroup run */
WrittenFile
writtenFile(const std::filesystem::path& file);

/** \return size and checksum of all files in a folder except summary.json, by relative path
 * \throws IoFailed a file cannot be read \ingroup run */
std::map<std::string, WrittenFile>
writtenFiles(const std::filesystem::path& folder);

/** \brief Checks that a file is unchanged since it was written. A missing file passes the check.
 * \param[in] whole whether to check the content, too, instead of the size alone
 * \throws IoFailed the file has changed \ingroup run */
void
requireAsWritten(const std::filesystem::path& file,
                 const WrittenFile& written,
                 bool whole);

} // namespace pcl6d
