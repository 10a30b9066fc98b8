// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/oriented_points.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

/** \file The part of an object that a scanner can see. Internal to the module. */
namespace pcl6d {

/** \brief A piece of the surface of an object that faces the scanner. */
struct FacingElement {
  std::uint32_t place;    ///< in the model
  Eigen::Vector3d point;  ///< [m] in the scan's frame, whose origin is the scanner
  Eigen::Vector3d normal; ///< unit, in the scan's frame
  double range;           ///< [m] > 0
  double cosine;          ///< of the angle between normal and sight, > 0
};

/** \brief The elements of a model that face the scanner and that no other one of them
 * hides.
 * \param[in] element [m] their size */
std::vector<FacingElement>
facingElements(const OrientedPoints& model,
               const Eigen::Isometry3d& T_scene_model,
               double element);

} // namespace pcl6d
