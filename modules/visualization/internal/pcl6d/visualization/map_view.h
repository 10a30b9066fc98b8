// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/visualization/camera.h>
#include <pcl6d/visualization/height_cut.h>
#include <pcl6d/visualization/map_cloud.h>
#include <pcl6d/visualization/overlay.h>

#include <array>
#include <optional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of MapView. */
struct MapViewOptions {
  int width = 1600; ///< [px] 200 to 8192
  /** [px] 200 to 8192; by default 9/16 of the width; of a panorama from its elevations */
  std::optional<int> height;
  int margin = 24; ///< [px] around everything; 0 to an eighth of the width
  PointColour colour = PointColour::kHeight;
  std::optional<ColourMap> colour_map; ///< by default a map suited to the colour
  /** values at both ends of the colours; by default from the points */
  std::optional<std::array<double, 2>> colour_range;
  Background background = Background::kDark;
  bool transparent = false; ///< in place of the background
  std::string title;        ///< top left; may be empty
  std::string final_label = "after";
  std::string initial_label = "before";
  bool draw_paths = true; ///< false: the paths serve only the cut
  double shading = 1;     ///< eye-dome lighting: how dark edges are; 0 to 5
  double point_size = 1;  ///< in mean distances of neighbours; > 0, up to 10
  /** more points are thinned evenly, by a fixed choice; > 0 */
  std::size_t max_points = 4000000;
  HeightCut cut; ///< by default leaves out a ceiling

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Content of a map view. */
struct MapViewScene : MapCloud {
  /** \brief A model drawn into the map. */
  struct Model {
    TriangleMesh mesh; ///< in the world [m]
    Colour colour{};
  };

  Trajectory trajectory; ///< final poses, or empty
  Trajectory initial;    ///< poses before the run, or empty
  Overlay overlay;       ///< drawn over points and poses
  std::vector<Model> models;
};

/** \brief Layout of a map view. */
struct MapViewLayout {
  int width = 0;  ///< [px]
  int height = 0; ///< [px]
  PictureBox map; ///< between title and colour bar
  double text_size = 12;
  Camera camera;
  double lowest_colour = 0;  ///< value at the lower end of the colours
  double highest_colour = 0; ///< the same at the upper end
  bool ceiling_hidden = false;
  std::size_t points_drawn = 0; ///< after thinning
};

struct MapViewPicture {
  Image image;
  MapViewLayout layout;
};

/** \brief A map seen by a camera, in perspective or as a panorama, with paths, overlay,
 * legend and colour bar.
 *
 * Points are splats with eye-dome lighting; a splat is as large as the distance to its
 * neighbours, which closes the surfaces. In buildings the ceiling is cut away (see
 * HeightCut), but not in a panorama.
 * \code
 * pcl6d::MapViewScene scene;
 * scene.points = map_points;
 * scene.trajectory = trajectory;
 * const auto picture = pcl6d::MapView().draw(scene); // from where most is seen
 * pcl6d::writePng("map.png", picture.image);
 * \endcode
 * \ingroup visualization */
class MapView {
public:
  /** \throws BadArgument an option is invalid */
  explicit MapView(const MapViewOptions& options = MapViewOptions());

  /** \return the box of the picture to be filled by cameras */
  PictureBox
  box() const;

  /** \brief Draws the view of a camera; by default the first of goodViewpoints().
   * \throws BadArgument no finite point, or as MapCloud::validate()
   * \throws IoFailed no display */
  MapViewPicture
  draw(const MapViewScene& scene, const std::optional<Camera>& camera = {}) const;

  /** \brief Draws the panorama around a scan, seen from its position.
   * \param[in] scene the points of the scan, in the world \throws BadArgument, IoFailed
   * as draw() */
  MapViewPicture
  drawPanorama(const MapViewScene& scene, const Eigen::Isometry3d& T_world_scan) const;

  /** \brief The cameras with the best view of the scene, best first.
   * \param[in] count 1 to 4 \throws BadArgument no finite point */
  std::vector<Camera>
  viewpoints(const MapViewScene& scene, std::size_t count) const;

  /** \brief A camera that shows the whole scene from a direction.
   * \param[in] azimuth [rad] \param[in] elevation [rad] as cameraOn()
   * \throws BadArgument no finite point */
  Camera
  cameraFrom(const MapViewScene& scene, double azimuth, double elevation) const;

private:
  ShownPoints
  shownPointsOf(const MapViewScene& scene, Projection projection) const;
  MapViewPicture
  drawShown(const MapViewScene& scene,
            const ShownPoints& shown,
            MapViewLayout layout) const;
  MapViewOptions options_;
};

} // namespace pcl6d
