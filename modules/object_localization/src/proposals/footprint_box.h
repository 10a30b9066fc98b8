// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

/** \file Upright boxes. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief A box on a plane. */
struct FootprintBox {
  Eigen::Isometry3d T_scene_box; ///< z up; the middle of the bottom, on the plane
  Eigen::Vector3d size;          ///< [m] the longer side first, then the height
};

/** \return the box over the smallest rectangle around the points in plan, from the
 * plane `up . p = height` to the highest point \param[in] points at least one */
FootprintBox
footprintBox(const Points& points, const Eigen::Vector3d& up, double height);

} // namespace pcl6d::object_localization
