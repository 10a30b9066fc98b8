// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

/** \return whether a file name ends so, whatever the case; extension: ".json" */
bool
hasExtension(const std::string& file, const std::string& extension);

/** \throws UsageError the file of an option, unless it is empty, has none of the
 * extensions */
void
requireExtension(const std::string& option,
                 const std::string& file,
                 const std::vector<std::string>& extensions);

} // namespace pcl6d::app
