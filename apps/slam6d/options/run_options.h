// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/option_table.h"

#include <pcl6d/common/option_spec.h>

#include <string>

namespace pcl6d::app {

/** \brief The options taken over from a finished run that is continued: the given options of
 * matching and of the processing of the map. Options of input, output and execution are not taken
 * over, nor are plug-ins, because a file must not choose the code that runs.
 * \param[in] run its folder \param[in] options of the program
 * \param[in] plugins the option that names plug-ins
 * \param[in] has_plugins the user gives plug-ins on the command line
 * \throws IoFailed summary.json cannot be read, or contains an option that runs do not have
 * \throws UsageError the run used plug-ins, and the user gives none */
BroughtOptions
optionsOfRun(const std::string& run,
             const OptionList& options,
             const OptionSpec& plugins,
             bool has_plugins);

} // namespace pcl6d::app
