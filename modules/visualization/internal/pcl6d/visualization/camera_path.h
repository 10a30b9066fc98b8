// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/camera.h>

#include <cstddef>
#include <vector>

/** \file The ways of a camera through an animation. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Camera path once around a scene, looking at the middle from constant distance
 * and height. \param[in] first the camera of the first picture \param[in] middle of the
 * scene
 * \param[in] count number of pictures, > 0; a further picture would repeat the first
 * \throws BadArgument count is 0 \ingroup visualization */
std::vector<Camera>
turntable(const Camera& first, const Eigen::Vector3d& middle, std::size_t count);

/** \brief Options of flyThrough(). */
struct FlyThroughOptions {
  std::size_t count = 200; ///< pictures, > 1
  double above = 0.7;      ///< [m] of the camera above the poses
  double behind = 0.0;     ///< [m] distance of the camera behind, along the path, >= 0
  /** [m] distance of the viewed position ahead, along the path, > 0 */
  double ahead = 6.0;
  double smoothing = 4.0;     ///< [m] length of the path's moving average, >= 0
  double field_of_view = 1.2; ///< [rad] between left and right, above 0 and below pi
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Camera path along a trajectory, at constant speed, with an upright picture.
 * \param[in] box of the picture for the camera
 * \throws BadArgument an option is invalid, or the path is shorter than 1 mm
 * \ingroup visualization */
std::vector<Camera>
flyThrough(const Trajectory& trajectory,
           const PictureBox& box,
           const FlyThroughOptions& options = {});

} // namespace pcl6d
