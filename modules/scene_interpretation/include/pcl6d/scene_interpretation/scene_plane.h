// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <Eigen/Geometry>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A plane prepared for interpretation (book 7.1.2): a piece of surface with its
 * sizes, in a frame with z up. \ingroup scene_interpretation */
struct ScenePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< towards the side that was seen
  bool side_known = false; ///< whether the visible side is known; else the sign of the
                           ///< normal is arbitrary
  std::vector<Eigen::Vector3d> corners; ///< [m] of the convex hull, in order
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m] of the hull's area
  double inclination = 0; ///< [rad] between plane and horizontal, in [0, pi/2]
  double area = 0;        ///< [m^2]
  double bottom = 0;      ///< [m] lowest corner
  double top = 0;         ///< [m] highest corner
  double width = 0;  ///< [m] along the plane's horizontal line; if level, the shorter
                     ///< side
  double length = 0; ///< [m] across the horizontal line; if level, the longer side
  std::optional<double> floor;   ///< [m] height of the floor of its storey
  std::optional<double> ceiling; ///< [m] height of the ceiling above
};

/** \brief Converts a plane to an upright frame.
 * \param[in] R_level_map turns the map's coordinates into the upright frame
 * \param[in] seen_from direction in the map, from the plane towards the sensor; zero:
 * unknown */
ScenePlane
levelledPlane(const Plane& plane,
              const Eigen::Matrix3d& R_level_map,
              const Eigen::Vector3d& seen_from);

/** \brief Measures of a single plane. */
enum class Measure {
  kArea,        ///< "area" [m^2]
  kWidth,       ///< "width" [m], see ScenePlane
  kLength,      ///< "length" [m], see ScenePlane
  kHeight,      ///< "height" [m] from the lowest to the highest point
  kInclination, ///< "inclination" [rad], in files [deg]: 0 level, 90 upright
  kBottom,      ///< "bottom" [m] lowest point over the floor of the storey
  kTop,         ///< "top" [m] highest point over the floor of the storey
  kGapToCeiling ///< "gap_to_ceiling" [m] from the highest point to the ceiling above
};

const char*
toString(Measure measure);

/** \return the measure with a name; nullopt for an unknown name */
std::optional<Measure>
measureFromName(const std::string& name);

/** \return the value; nullopt if it needs an unknown floor or ceiling */
std::optional<double>
measured(Measure measure, const ScenePlane& plane);

/** \return whether the convex hulls of two planes overlap in plan, seen from above, or
 * are at most `margin` [m] apart; upright planes count as lines */
bool
overlapInPlan(const ScenePlane& a, const ScenePlane& b, double margin = 0);

/** \return distance of two hulls [m], 0 if they meet */
double
hullDistance(const ScenePlane& a, const ScenePlane& b);

} // namespace pcl6d
