// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/io/json_object.h>

#include <string>

/** \file Reading of summary.json, which may come from anybody: nothing in it is believed
 * before it is checked. */
namespace pcl6d::run_files {

/** The key of the bytes of a scan's name, in hexadecimal digits, where JSON cannot hold
 * them or should not: names that are no UTF-8, or have control characters. */
constexpr const char* kFileBytes = "file_bytes";

/** \return whether JSON holds the name as it is, and a terminal may show it */
bool
isPlainName(const std::string& name);

/** \return two hexadecimal digits a byte */
std::string
hexOf(const std::string& bytes);

/** \return the name as JSON shows it: what is no UTF-8 is replaced */
std::string
shownName(const std::string& name);

/** \return the run that a summary tells of. Checked are: types; numbers finite and in their
 * range; poses rigid; covariances symmetric and without negative variances; each index of a
 * scan once; names of files, which name nothing outside of their folder.
 * \throws IoFailed naming file and place */
RunResult
runFrom(const JsonValue& json);

} // namespace pcl6d::run_files
