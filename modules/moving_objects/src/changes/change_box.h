// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/run_changes.h>

namespace pcl6d::moving_objects {

/** \return the upright box around points with sides nearest to the points, among turns by a
 * degree: of an object with two visible sides, the box has both
 * \note Source: X. Zhang et al., "Efficient L-shape fitting for vehicle detection using laser
 * scanners", IV 2017: closeness
 * \param[in] points [m] at least one
 * \param[in] up unit vector */
ChangeBox
boxAbout(const Points& points, const Eigen::Vector3d& up);

/** \return a rotation from a frame with z axis `up`; its x and y axes are arbitrary */
Eigen::Matrix3d
uprightAxes(const Eigen::Vector3d& up);

} // namespace pcl6d::moving_objects
