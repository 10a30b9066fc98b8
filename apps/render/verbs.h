// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kRender = "pcl_slam6d_render"; ///< the program's name

/** \brief `animation RUN`: the run as frames and a video.
 * \param[in] arguments after the verb \return the exit code */
int
runAnimation(const std::vector<std::string>& arguments);

/** \brief `picture RUN`: views of a run as PNG files.
 * \param[in] arguments after the verb \return the exit code */
int
runPicture(const std::vector<std::string>& arguments);

/** \brief `report RUN`: a page that tells all of a run.
 * \param[in] arguments after the verb \return the exit code */
int
runReport(const std::vector<std::string>& arguments);

} // namespace pcl6d::app
