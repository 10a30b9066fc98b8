// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/polygon.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What a surface is to a person (book 7.1.2): the labels of the book's network.
 * As a number it is the field `label` of a point. Rules of a user's own may name more
 * (Plane::label). \ingroup common */
enum class PlaneLabel { kNone = 0, kFloor = 1, kCeiling = 2, kWall = 3, kDoor = 4 };

/** \return "none", "floor", "ceiling", "wall" or "door" */
/** The words of the labels, in their order. */
inline constexpr Named<PlaneLabel> kPlaneLabels[] = {{PlaneLabel::kNone, "none"},
                                                     {PlaneLabel::kFloor, "floor"},
                                                     {PlaneLabel::kCeiling, "ceiling"},
                                                     {PlaneLabel::kWall, "wall"},
                                                     {PlaneLabel::kDoor, "door"}};

const char*
toString(PlaneLabel label);

/** \brief A bounded part of the plane `normal . p = offset` (book 7.1.1). */
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit length
  double offset = 0;                                 ///< [m] >= 0
  std::string label = "none"; ///< what it is: toString(PlaneLabel) or a user's word
  std::vector<Eigen::Vector3d> hull; ///< [m] convex, counter-clockwise against normal
  double area = 0;                   ///< [m^2]
  std::size_t inliers = 0;           ///< points on it
  double rms = 0;                    ///< [m] of their distances to the plane
};

/** \brief Turns a plane's normal around, if need be, so that offset >= 0; where the
 * plane runs through the origin (|offset| <= 1e-12 m), the first component of the
 * normal other than 0 becomes positive. The hull is turned with it. */
void
orientPlane(Plane& plane);

} // namespace pcl6d
