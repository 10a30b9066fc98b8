// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/ray_caster.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The vehicle that carries the scanner. */
struct RobotOptions {
  double sensor_height = 0.9; ///< [m] scanner above the contact plane, > 0
  double wheel_base = 0.5;    ///< [m] between front and rear contact, > 0
  double track_width = 0.4;   ///< [m] between left and right contact, > 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief How a path gets past its waypoints. */
enum class PathCorners {
  kRounded, ///< a uniform quadratic B-spline of them: smooth, straight where three of them
            ///< lie on a line
  kSharp    ///< straight from one to the next
};

/** \brief A closed drive through a scene with six degrees of freedom.
 *
 * The robot heads along it and stands on what is below: height, roll and pitch follow from
 * where its four contacts meet the scene. \ingroup simulation */
class RobotPath {
public:
  /** \param[in] waypoints control points, closed from last to first; their height must
   * be within 0.5 m of the floor and tells storeys apart
   * \throws BadArgument fewer than 3 waypoints, two neighbours that coincide in plan,
   * or an option breaks its rule */
  RobotPath(const std::vector<Eigen::Vector3d>& waypoints,
            const RobotOptions& options,
            PathCorners corners = PathCorners::kRounded);

  /** \return the length in plan [m] of one round */
  double
  length() const;

  /** \return the height of the scanner above the contact plane [m] */
  double
  sensorHeight() const
  {
    return options_.sensor_height;
  }

  const RobotOptions&
  robot() const
  {
    return options_;
  }

  /** \return where straight legs begin [m] of the way, and where the last one ends; empty
   * if corners are rounded */
  std::vector<double>
  corners() const;

  /** \return the direction in plan, of unit length, in which the path leads
   * \param[in] s as of sensorPose(); at a sharp corner that of the leg that begins there */
  Eigen::Vector2d
  heading(double s) const;

  /** \param[in] s way in plan [m], any number; wraps after each round
   * \return T_scene_sensor: x ahead, z square to the contact plane
   * \throws ComputeFailed there is no floor below the path */
  Eigen::Isometry3d
  sensorPose(const RayCaster& caster, double s) const;

  /** \brief The same of a robot that turns there. \param[in] heading unit vector */
  Eigen::Isometry3d
  sensorPose(const RayCaster& caster, double s, const Eigen::Vector2d& heading) const;

private:
  struct Point {
    Eigen::Vector3d position;
    Eigen::Vector3d tangent; // not of unit length
  };
  Point
  pointAtStep(double step) const;
  Point
  pointAt(double s) const;

  std::vector<Eigen::Vector3d> waypoints_;
  RobotOptions options_;
  PathCorners corners_;
  std::vector<double> way_; // [m] travelled at equal steps of the spline's parameter
};

} // namespace pcl6d
