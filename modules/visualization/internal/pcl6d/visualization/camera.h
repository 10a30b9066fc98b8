// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visualization/top_view_layout.h>

#include <Eigen/Geometry>

#include <cmath>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How a camera maps directions onto the picture. */
enum class Projection {
  kPerspective, ///< straight lines stay straight
  kPanorama     ///< columns are azimuths, rows elevations, all around
};

/** \brief A camera in the world. \ingroup visualization */
struct Camera {
  Projection projection = Projection::kPerspective;
  /** pose of the camera; axes: x to the right, y down, z forward */
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  /** [px] focal length; of a panorama [px/rad] */
  double scale = 1000;
  Eigen::Vector2d centre{0, 0}; ///< [px] where the forward axis meets the picture

  /** \param[in] place position in the camera's frame [m]
   * \return column, row [px] and depth [m]; empty if the camera cannot see the position */
  std::optional<Eigen::Vector3d>
  project(const Eigen::Vector3d& place) const
  {
    constexpr double kNearest = 0.05; // [m]
    if (projection == Projection::kPanorama) {
      const double range = place.norm();
      if (!(range > kNearest))
        return {};
      return Eigen::Vector3d(
          centre.x() + scale * std::atan2(place.x(), place.z()),
          centre.y() + scale * std::atan2(place.y(), std::hypot(place.x(), place.z())),
          range);
    }
    if (!(place.z() > kNearest))
      return {};
    const double zoom = scale / place.z();
    return Eigen::Vector3d(
        centre.x() + zoom * place.x(), centre.y() + zoom * place.y(), place.z());
  }

  /** \return column, row [px] and depth [m] of a position in the world; empty if the
   * camera cannot see the position */
  std::optional<Eigen::Vector3d>
  toPixel(const Eigen::Vector3d& world) const
  {
    return project(T_world_camera.inverse() * world);
  }
};

/** \brief A camera that looks at points from a direction and shows nearly every point
 * in a box of the picture, as large as possible. Isolated far points are ignored.
 * \param[in] points [m] finite, at least one
 * \param[in] azimuth [rad] of the camera seen from the points, from x to y
 * \param[in] elevation [rad] of the camera above the horizon */
Camera
cameraOn(const Points& points, double azimuth, double elevation, const PictureBox& box);

/** \brief The cameras with the best view, best first: points fill the picture and few
 * points are occluded. Their azimuths lie at least 60 degrees apart.
 * \param[in] points [m] finite, at least one \param[in] count number of cameras, 1 to 4 */
std::vector<Camera>
goodViewpoints(const Points& points, const PictureBox& box, std::size_t count);

/** \brief A panorama around a scan, as wide as the box; it covers the elevations of the
 * points. Azimuths: the full circle, with x of the scan in the middle; an empty gap of
 * a quarter circle or more is left out. Moves the box's lower end to fit.
 * \param[in] points in the scan's frame [m], finite, at least one */
Camera
panoramaFrom(const Eigen::Isometry3d& T_world_scan,
             const Points& points,
             PictureBox& box);

} // namespace pcl6d
