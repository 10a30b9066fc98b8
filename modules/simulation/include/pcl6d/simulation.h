// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file All public headers of the module simulation. Simulated worlds, drives through these
 * worlds, and scans with exact truth. */
#include <pcl6d/simulation/body_ways.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/ground_map.h>
#include <pcl6d/simulation/ground_survey.h>
#include <pcl6d/simulation/intruders.h>
#include <pcl6d/simulation/moving_bodies.h>
#include <pcl6d/simulation/moving_body.h>
#include <pcl6d/simulation/moving_scene.h>
#include <pcl6d/simulation/odometry_model.h>
#include <pcl6d/simulation/path_check.h>
#include <pcl6d/simulation/ray_caster.h>
#include <pcl6d/simulation/robot_motion.h>
#include <pcl6d/simulation/robot_path.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/scene_file.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/scene_view.h>
#include <pcl6d/simulation/simulation_scene.h>
#include <pcl6d/simulation/simulator.h>
#include <pcl6d/simulation/terrain.h>
#include <pcl6d/simulation/traffic.h>
#include <pcl6d/simulation/triangle_scene.h>
#include <pcl6d/simulation/truth_fields.h>
#include <pcl6d/simulation/way_rules.h>
