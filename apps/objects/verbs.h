// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kObjects = "pcl_slam6d_objects"; ///< the program's name

/** \brief `locate INPUT --model MODEL... -o OUT_DIR`: objects and their poses.
 * \param[in] arguments after the verb \return the exit code */
int
runLocate(const std::vector<std::string>& arguments);

/** \brief `train MODEL... --background SCANS -o CASCADE.xml`: a detector from models.
 * \param[in] arguments after the verb \return the exit code */
int
runTrain(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
