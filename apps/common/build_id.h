// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return an identifier of this build of the program and its libraries, derived from the
 * sizes and times of the files. The results of two builds may differ in their bits */
std::string
buildId();

} // namespace pcl6d::app
