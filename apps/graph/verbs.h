// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kGraph = "pcl_slam6d_graph"; ///< the program's name

/** \brief `optimize IN -o OUT`: the poses that fit the links of a pose graph best.
 * \param[in] arguments after the verb \return the exit code */
int
runOptimize(const std::vector<std::string>& arguments);

/** \brief `info IN`: what a pose graph holds.
 * \param[in] arguments after the verb \return the exit code */
int
runInfo(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
