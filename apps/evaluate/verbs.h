// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kEvaluate = "pcl_slam6d_evaluate"; ///< the program's name

/** \brief `trajectory ESTIMATE REFERENCE`: errors of a trajectory against a reference.
 * \param[in] arguments after the verb \return the exit code */
int
runTrajectory(const std::vector<std::string>& arguments);

/** \brief `icp SCAN_A SCAN_B`: the basin of convergence of ICP.
 * \param[in] arguments after the verb \return the exit code */
int
runIcp(const std::vector<std::string>& arguments);

/** \brief `lengths FILE`: ratios of lengths in a map against those in a reference.
 * \param[in] arguments after the verb \return the exit code */
int
runLengths(const std::vector<std::string>& arguments);

/** \brief `map RUN_DIR`: how good a map is, without a reference path.
 * \param[in] arguments after the verb \return the exit code */
int
runMap(const std::vector<std::string>& arguments);

/** \brief `mcl SCAN_DIR --map FILE`: a reference path by localisation in a known plan.
 * \param[in] arguments after the verb \return the exit code */
int
runMcl(const std::vector<std::string>& arguments);

/** \brief `suite SUITE.json`: several methods over several data sets.
 * \param[in] arguments after the verb \return the exit code */
int
runSuite(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
