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

/** \brief Semantic label of a surface (book 7.1.2): the labels of the book's network. The
 * numeric value is the field `label` of a point. User-defined rules may add labels
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
  std::string label = "none";        ///< toString(PlaneLabel) or a user's word
  std::vector<Eigen::Vector3d> hull; ///< [m] convex, counter-clockwise against normal
  double area = 0;                   ///< [m^2]
  std::size_t inliers = 0;           ///< points on the plane
  double rms = 0;                    ///< [m] of their distances to the plane
};

/** \brief Flips a plane's normal, if needed, to make offset >= 0. For a plane through the origin
 * (|offset| <= 1e-12 m), the first non-zero component of the normal becomes positive. The hull
 * is reversed accordingly. */
void
orientPlane(Plane& plane);

} // namespace pcl6d
