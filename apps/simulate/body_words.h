// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulate/settings.h"

#include <pcl6d/simulation/moving_body.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace pcl6d::app {

/** \brief Describes moving bodies for scene.json: class, way [m], and times [s] or
 * speed of each body.
 * \param[in] T_world_scene from the frame of the ways to the frame of the scans */
nlohmann::ordered_json
describeBodies(const std::vector<MovingBody>& bodies,
               const Eigen::Isometry3d& T_world_scene);

/** \brief Describes the robot's motion during scans for scene.json. \param[in] speed
 * [m/s] */
nlohmann::ordered_json
describeMotion(const SimulateSettings& settings, double speed);

} // namespace pcl6d::app
