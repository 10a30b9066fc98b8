// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <filesystem>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes summary.json (fields: share/doc/run_folder.md), atomically.
 * \throws IoFailed the file cannot be written \ingroup run */
void
writeRunSummary(const std::filesystem::path& path, const RunResult& result);

/** \brief Inverse of writeRunSummary(); files of schema_version 1 are read, too.
 * \throws IoFailed naming the file and the missing or wrong entry: no JSON, an unknown
 * schema_version, a field of another type
 * \ingroup run */
RunResult
readRunSummary(const std::filesystem::path& path);

/** \throws IoFailed the folder has no summary.json, hence holds no run */
void
requireRun(const std::filesystem::path& folder);

} // namespace pcl6d
