// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visualization/map_cloud.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of PlaneView. */
struct PlaneViewOptions {
  int width = 1600;              ///< [px] 200 to 8192
  int height = 1100;             ///< [px] 200 to 8192
  std::optional<double> azimuth; ///< [rad] of the camera seen from the scene, from x to
                                 ///< y; by default where most area is seen
  double elevation = 0.75; ///< [rad] of the camera above the horizon; in (0, pi/2)
  Background background = Background::kDark;
  bool transparent = false; ///< in place of the background
  std::string title;        ///< top left; may be empty
  /** more points are thinned evenly, by a fixed choice; > 0 */
  std::size_t max_points = 2000000;

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Content of a plane view. */
struct PlaneViewScene {
  Points points; ///< [m] in one frame; NaN is skipped
  /** per point the index of its plane + 1; 0: no plane */
  std::vector<std::uint32_t> plane_of;
  std::vector<Plane> planes;
  std::vector<Eigen::Vector3d> seen_from; ///< per plane: unit normal to the side seen
};

/** \brief Layout of a plane view. */
struct PlaneViewLayout {
  int width = 0;                ///< [px]
  int height = 0;               ///< [px]
  double metres_per_pixel = 1;  ///< along both axes of the picture
  Eigen::Vector3d to_camera;    ///< unit vector from the scene to the camera
  Eigen::Vector3d right;        ///< unit vector of the world along the columns
  Eigen::Vector3d up;           ///< unit vector of the world against the rows
  Eigen::Vector2d centre{0, 0}; ///< [m] along right, up in the middle of the picture
  std::vector<bool> hidden;     ///< per plane: faces away from the camera
  std::size_t points_drawn = 0;

  /** \return column and row of a position [m] */
  Eigen::Vector2d
  toPixel(const Eigen::Vector3d& place) const
  {
    const Eigen::Vector2d flat(right.dot(place), up.dot(place));
    const Eigen::Vector2d offset = (flat - centre) / metres_per_pixel;
    return {0.5 * width + offset.x(), 0.5 * height - offset.y()};
  }
};

/** \brief Planes in a cloud from obliquely above, in parallel projection: each with a
 * colour of its own, the hull and, if large enough, number and label; points on no
 * plane are grey. As in a doll's house, planes facing away from the camera (the
 * ceiling, the near walls of a room) are left open.
 * \code
 * pcl6d::PlaneView().write("planes.png", scene);
 * \endcode
 * \ingroup visualization */
class PlaneView {
public:
  /** \throws BadArgument an option is invalid */
  explicit PlaneView(const PlaneViewOptions& options = PlaneViewOptions());

  /** \brief Draws. \param[out] image the picture \return the layout
   * \throws BadArgument no finite point, plane_of not one per point, seen_from not one
   * per plane, or a plane_of beyond the planes
   * \throws IoFailed no display */
  PlaneViewLayout
  draw(const PlaneViewScene& scene, Image& image) const;

  /** \brief Draws into a PNG file, atomically. \return the layout
   * \throws BadArgument as draw() \throws IoFailed as draw(), or the file cannot be written */
  PlaneViewLayout
  write(const std::filesystem::path& path, const PlaneViewScene& scene) const;

private:
  PlaneViewOptions options_;
};

} // namespace pcl6d
