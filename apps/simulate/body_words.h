// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulate/settings.h"

#include <pcl6d/simulation/moving_body.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace pcl6d::app {

/** \brief What moves, for scene.json: of each body its class, its way [m] and when it is
 * where [s], or its speed.
 * \param[in] T_world_scene from the frame of the ways to that of the scans */
nlohmann::ordered_json
describeBodies(const std::vector<MovingBody>& bodies,
               const Eigen::Isometry3d& T_world_scene);

/** \brief How the robot drives on while it scans, for scene.json. \param[in] speed [m/s] */
nlohmann::ordered_json
describeMotion(const SimulateSettings& settings, double speed);

} // namespace pcl6d::app
