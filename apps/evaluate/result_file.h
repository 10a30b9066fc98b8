// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \return whether a file name ends so, whatever the case; extension: ".json" */
bool
hasExtension(const std::string& file, const std::string& extension);

/** \brief Before the work: looks whether the file of an option can be its result; empty: none
 * is asked for.
 * \throws UsageError it has none of the extensions
 * \throws IoFailed it cannot be written */
void
requireResultFile(const std::string& option,
                  const std::string& file,
                  const std::vector<std::string>& extensions);

} // namespace pcl6d::app
