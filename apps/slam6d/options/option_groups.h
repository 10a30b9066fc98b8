// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/options/settings.h"

#include <pcl6d/common/option_spec.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \return the options of pcl_slam6d in the order of --help: the library's options (Slam6DOptions),
 * and the program's own options, each defined once in input_options.cpp or option_groups.cpp.
 * \param[in,out] settings set by the options; kept by reference
 * \param[in,out] used the lengths used by a run; kept by reference */
OptionList
optionsOf(Settings& settings, Slam6DParameters& used);

/** \throws UsageError `--scale` is among the arguments; the message explains why the option does
 * not exist */
void
refuseScale(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
