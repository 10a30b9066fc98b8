// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kConvert = "pcl_slam6d_convert"; ///< the program's name

/** \brief `lines LINES.csv -o OUT.pcd`: raw 2D lines and drive angles as a 3D scan.
 * \param[in] arguments after the verb \return the exit code */
int
runLines(const std::vector<std::string>& arguments);

/** \brief `scans IN -o OUT`: a scan or a folder of scans in another format.
 * \param[in] arguments after the verb \return the exit code */
int
runScans(const std::vector<std::string>& arguments);

/** \brief `stereo LEFT RIGHT CALIB -o OUT`: a scan from the pictures of two cameras.
 * \param[in] arguments after the verb \return the exit code */
int
runStereo(const std::vector<std::string>& arguments);

/** \brief `trajectory IN -o OUT`: poses in another format.
 * \param[in] arguments after the verb \return the exit code */
int
runTrajectory(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
