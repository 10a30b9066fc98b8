// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return what tells this build of the program and its libraries from others: a number of
 * their files, sizes and times. What another build has computed may have other bits */
std::string
buildId();

} // namespace pcl6d::app
