// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <vector>

/** \file
 * Ground truth of a scene's planes and objects, for evaluating plane detection, object
 * localisation and semantic maps (book chapter 7). */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Numbers the planes of a scene from 1: assigns each large flat surface the id
 * of its plane.
 *
 * Surfaces share a plane if they lie in it within 1 um, are equally oriented, have
 * equal label and object, and touch. A surface keeps its label if it fits the
 * orientation within 10 deg: floors face up, ceilings down, walls and doors sideways.
 * Other surfaces, and surfaces without a plane, get the label none.
 * \param[in] min_area [m^2] of a surface \ingroup simulation */
void
numberPlanes(TriangleScene& scene, double min_area = 0.1);

/** \brief The planes of a numbered scene; the plane with id i has index i - 1. Area and
 * hull cover the whole surfaces, including parts inside other bodies; the area excludes
 * holes.
 * \param[in] T_scene_world frame of the result in the coordinates of the scene */
std::vector<Plane>
scenePlanes(const TriangleScene& scene,
            const Eigen::Isometry3d& T_scene_world = Eigen::Isometry3d::Identity());

} // namespace pcl6d
