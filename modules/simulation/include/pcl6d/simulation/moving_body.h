// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What a moving body does at the end of its way. */
enum class WayEnd {
  kStop,   ///< stays there
  kReturn, ///< turns on the spot and goes back, for ever
  kClosed  ///< goes straight on to the first corner, for ever
};

/** \brief A thing that moves through a scene while it is scanned: a person, a car.
 *
 * It follows straight legs between corners with constant speed, upright, its x axis
 * ahead in plan, and turns at once where a leg ends. \ingroup simulation */
struct MovingBody {
  std::string name = "body";
  /// in the body's own frame: x ahead, z up, origin where it touches the ground
  TriangleScene shape;
  std::vector<Eigen::Vector3d> way; ///< [m] corners in the scene, >= 2 apart in plan
  double speed = 1;                 ///< [m/s] along the way, in [0, 1000]
  double start = 0;                 ///< [m] along the way at time 0, >= 0
  WayEnd end = WayEnd::kReturn;

  /** \throws BadArgument naming the body and what breaks its rule */
  void
  validate() const;

  /** \param[in] time [s] of the simulation, >= 0
   * \return T_scene_body. The body must be valid */
  Eigen::Isometry3d
  poseAt(double time) const;
};

} // namespace pcl6d
