// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return five lines for a user who calls a program without arguments: its purpose, the
 * three most useful commands, and where the options are listed. \param[in] program its name,
 * "pcl_slam6d_render"; empty if no program has this name */
std::string
firstSteps(const std::string& program);

} // namespace pcl6d::app
