// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/height_cut.h>
#include <pcl6d/visualization/map_cloud.h>
#include <pcl6d/visualization/overlay.h>
#include <pcl6d/visualization/top_view_layout.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of TopView; the defaults suit maps from a room to a campus. */
struct TopViewOptions {
  int width = 1600;          ///< [px] 200 to 8192
  std::optional<int> height; ///< [px] 200 to 8192; by default follows the map's shape
  int margin = 24;           ///< [px] around everything; 0 to width / 8
  PointColour colour = PointColour::kHeight;
  std::optional<ColourMap> colour_map; ///< by default a map suited to the colour
  Background background = Background::kDark;
  bool transparent = false;             ///< in place of the background
  std::string title;                    ///< top left; may be empty
  std::string final_label = "after";    ///< of the trajectory, in the legend
  std::string initial_label = "before"; ///< of the initial trajectory
  bool draw_paths = true;               ///< false: the paths serve only the cut
  std::optional<double> point_size;     ///< [px] > 0; by default closes the gaps
  /** more points are thinned evenly, by a fixed choice; > 0 */
  std::size_t max_points = 4000000;
  HeightCut cut; ///< by default leaves out a ceiling
  std::optional<Eigen::AlignedBox2d>
      area; ///< [m] visible area; by default the extent without isolated far points
  double shading = 0; ///< eye-dome lighting: darkness of edges; 0 to 5, 0: no lighting

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Content of a top view. */
struct TopViewScene : MapCloud {
  Trajectory trajectory; ///< final poses, or empty
  Trajectory initial;    ///< poses before the run, or empty
  Points
      /** [m] dynamic points, red over the other points, or empty; NaN is skipped */
      moving;
  Overlay overlay; ///< drawn over points and poses
};

/** \brief A picture and its layout. */
struct TopViewPicture {
  Image image;
  TopViewLayout layout;
};

/** \brief Map and trajectory from straight above: x to the right, y up, orthographic, with
 * scale bar, legend and colour bar.
 *
 * Drawn by VTK on the PrivateDisplay. The map area leaves out isolated far points. In buildings
 * the ceiling would hide the rooms below: HeightCut detects the ceiling and cuts it away.
 * \code
 * pcl6d::TopViewScene scene;
 * scene.points = map_points;
 * scene.trajectory = trajectory;
 * pcl6d::TopView().write("top_view.png", scene);
 * \endcode
 * \ingroup visualization */
class TopView {
public:
  /** \throws BadArgument an option is invalid */
  explicit TopView(const TopViewOptions& options = TopViewOptions());

  /** \throws BadArgument neither a finite point nor a pose nor an overlay, no point in
   * the slice, or as MapCloud::validate()
   * \throws IoFailed no display */
  TopViewPicture
  draw(const TopViewScene& scene) const;

  /** \brief Draws into a PNG file, atomically. \return the layout
   * \throws BadArgument as draw() \throws IoFailed as draw(), or the file cannot be written */
  TopViewLayout
  write(const std::filesystem::path& path, const TopViewScene& scene) const;

private:
  TopViewOptions options_;
};

} // namespace pcl6d
