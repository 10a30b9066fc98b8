// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <filesystem>
#include <map>
#include <string>

/** \file The files of a run, by which a reader knows that they are those of its summary. */
namespace PCL6D_EXPORTS pcl6d {

/** \return size and checksum of a file \throws IoFailed it cannot be read \ingroup run */
WrittenFile
writtenFile(const std::filesystem::path& file);

/** \return those of all files below a folder but its summary.json, by their paths in it
 * \throws IoFailed a file cannot be read \ingroup run */
std::map<std::string, WrittenFile>
writtenFiles(const std::filesystem::path& folder);

/** \brief Makes sure that a file is as it was written. One that is not there is none that was
 * changed.
 * \param[in] whole whether its content is looked at, too, not only its size
 * \throws IoFailed it differs \ingroup run */
void
requireAsWritten(const std::filesystem::path& file,
                 const WrittenFile& written,
                 bool whole);

} // namespace pcl6d
