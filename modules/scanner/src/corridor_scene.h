// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/simulation_scene.h>

namespace pcl6d {

SimulationScene
corridorScene();

} // namespace pcl6d
