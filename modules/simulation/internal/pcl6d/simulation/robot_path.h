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
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Shape of a path at its waypoints. */
enum class PathCorners {
  kRounded, ///< uniform quadratic B-spline: smooth, straight along collinear waypoints
  kSharp    ///< straight from waypoint to waypoint
};

/** \brief A closed drive through a scene with six degrees of freedom.
 *
 * The robot heads along the path and stands on the floor: height, roll and pitch follow
 * from the points where its four contacts meet the scene. \ingroup simulation */
class RobotPath {
public:
  /** \param[in] waypoints control points, closed from last to first; their height must
   * be within 0.5 m of the floor and selects the storey
   * \throws BadArgument fewer than 3 waypoints, two neighbours that coincide in plan,
   * or an option is invalid */
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

  /** \return distances [m] along the way at which straight legs begin, and the end of
   * the last leg; empty for rounded corners */
  std::vector<double>
  corners() const;

  /** \return the direction of the path in plan, of unit length
   * \param[in] s see sensorPose(); at a sharp corner the direction of the leg that
   * begins there */
  Eigen::Vector2d
  heading(double s) const;

  /** \param[in] s way in plan [m], any number; wraps after each round
   * \return T_scene_sensor: x ahead, z normal to the contact plane
   * \throws ComputeFailed no floor below the path */
  Eigen::Isometry3d
  sensorPose(const RayCaster& caster, double s) const;

  /** \brief The pose of a robot that turns there. \param[in] caster the scene
   * \param[in] s way in plan [m] \param[in] heading unit vector */
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
