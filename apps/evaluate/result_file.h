// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \return whether a file name has the extension, in any case; extension: ".json" */
bool
hasExtension(const std::string& file, const std::string& extension);

/** \brief Checks before the work whether the file of an option can be written; empty:
 * no file was asked for.
 * \throws UsageError unknown extension
 * \throws IoFailed the file cannot be written */
void
requireResultFile(const std::string& option,
                  const std::string& file,
                  const std::vector<std::string>& extensions);

} // namespace pcl6d::app
