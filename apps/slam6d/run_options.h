// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/option_table.h"

#include <string>

namespace pcl6d::app {

/** \brief The options that a finished run brings when another goes on with it: those that
 * say how scans are matched and what is made of the map, as far as they were given. What it
 * read, where it wrote and how it ran is not taken from it; and no plug-in is, as a file must
 * not choose the code that runs.
 * \param[in] run its folder \param[in] has_plugins the user gives plug-ins himself
 * \throws IoFailed summary.json cannot be read, or holds an option that no run has
 * \throws UsageError the run used plug-ins, and the user gives none */
BroughtOptions
optionsOfRun(const std::string& run, bool has_plugins);

} // namespace pcl6d::app
