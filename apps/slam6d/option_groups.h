// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/settings.h"

#include <string>
#include <vector>

namespace pcl6d::app {

class OptionTable;

/** \brief Adds the options of pcl_slam6d to a table, group by group. They fill in the settings,
 * which are kept by reference. \param[out] joins whether the arguments are runs to be joined */
void
addOptions(OptionTable& table, Settings& settings, bool& joins);

/** \throws UsageError `--scale` is among the words; says why there is no such option */
void
refuseScale(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
