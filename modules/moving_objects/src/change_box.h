// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/run_changes.h>

namespace pcl6d::moving_objects {

/** \return the upright box about points whose sides are nearest to them, of turns by a
 * degree: of a thing of which two sides were seen, the box has these
 * \note Source: X. Zhang et al., "Efficient L-shape fitting for vehicle detection using laser
 * scanners", IV 2017: closeness
 * \param[in] points [m] at least one \param[in] up unit vector */
ChangeBox
boxAbout(const Points& points, const Eigen::Vector3d& up);

/** \return a motion from a frame with this z axis, its x and y axes as they come */
Eigen::Matrix3d
uprightAxes(const Eigen::Vector3d& up);

} // namespace pcl6d::moving_objects
