// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/io/json_object.h>

#include <string>

/** \file Reading of summary.json from untrusted sources: every value is checked before use. */
namespace pcl6d::run_files {

/** Key of a scan's name in bytes, as hexadecimal digits, for names that JSON cannot or should not
 * contain: not UTF-8, or with control characters. */
constexpr const char* kFileBytes = "file_bytes";

/** \return whether JSON represents the name exactly, and a terminal can show it safely */
bool
isPlainName(const std::string& name);

/** \return two hexadecimal digits a byte */
std::string
hexOf(const std::string& bytes);

/** \return the name as shown in JSON: bytes outside UTF-8 are replaced */
std::string
shownName(const std::string& name);

/** \return the run described by a summary, after checks of types; finite numbers within their
 * range; rigid poses; symmetric covariances without negative variances; unique indices of scans;
 * and file names without a path out of their folder.
 * \throws IoFailed naming file and entry */
RunResult
runFrom(const JsonValue& json);

} // namespace pcl6d::run_files
