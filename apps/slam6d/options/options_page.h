// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return share/doc/options.md: all options of pcl_slam6d, and the fields of Slam6DOptions without
 * an option, stage by stage */
std::string
optionsPage();

} // namespace pcl6d::app
