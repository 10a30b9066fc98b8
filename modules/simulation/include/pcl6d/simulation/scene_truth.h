// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <vector>

/** \file
 * What a scene knows of its planes and objects: the truth against which plane detection,
 * object localisation and semantic maps are measured (book chapter 7). */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Gives every flat surface that is large enough the id of its plane, from 1.
 *
 * Surfaces share a plane if they lie in it within 1 um, face the same way, have the same
 * label and object, and touch. A surface's label is kept if it fits the way that it
 * faces, within 10 deg: floors face up, ceilings down, walls and doors aside; other
 * surfaces, and those without a plane, get the label none.
 * \param[in] min_area [m^2] of a surface \ingroup simulation */
void
numberPlanes(TriangleScene& scene, double min_area = 0.1);

/** \brief The planes of a scene whose surfaces are numbered: the one with id i at place
 * i - 1. Area and hull are those of the whole surfaces, parts inside other bodies
 * included, holes left out of the area.
 * \param[in] T_scene_world frame of the result in the coordinates of the scene */
std::vector<Plane>
scenePlanes(const TriangleScene& scene,
            const Eigen::Isometry3d& T_scene_world = Eigen::Isometry3d::Identity());

} // namespace pcl6d
