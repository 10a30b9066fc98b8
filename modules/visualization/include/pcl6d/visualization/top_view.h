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

/** \brief Knobs of TopView; the defaults suit maps of a room as well as of a campus. */
struct TopViewOptions {
  int width = 1600;          ///< [px] 200 to 8192
  std::optional<int> height; ///< [px] 200 to 8192; by default follows the map's shape
  int margin = 24;           ///< [px] around everything; 0 to width / 8
  PointColour colour = PointColour::kHeight;
  std::optional<ColourMap> colour_map; ///< by default one that suits the colour
  Background background = Background::kDark;
  bool transparent = false;             ///< in place of the background
  std::string title;                    ///< top left; may be empty
  std::string final_label = "after";    ///< of the trajectory, in the legend
  std::string initial_label = "before"; ///< of the initial trajectory
  bool draw_paths = true;               ///< false: they serve the cut alone
  std::optional<double> point_size;     ///< [px] > 0; by default closes the gaps
  std::size_t max_points = 4000000; ///< more are thinned evenly, always the same; > 0
  HeightCut cut;                    ///< by default leaves out a ceiling
  std::optional<Eigen::AlignedBox2d>
      area;           ///< [m] to be seen; by default all but single points far away
  double shading = 0; ///< eye-dome lighting: how dark edges are; 0 to 5, 0: none

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What is to be seen. */
struct TopViewScene : MapCloud {
  Trajectory trajectory; ///< final poses, or empty
  Trajectory initial;    ///< poses before the run, or empty
  Points
      moving; ///< [m] what moved, red over the other points, or empty; NaN is skipped
  Overlay overlay; ///< drawn over points and poses
};

/** \brief A picture and where things are on it. */
struct TopViewPicture {
  Image image;
  TopViewLayout layout;
};

/** \brief Map and trajectory from straight above: x to the right, y up, orthographic,
 * with scale bar, legend and colour bar.
 *
 * Drawn by VTK on the PrivateDisplay. The map area leaves out single points that lie
 * far away from all others. In buildings the ceiling would hide everything below it: it
 * is found (see HeightCut) and cut away.
 * \code
 * pcl6d::TopViewScene scene;
 * scene.points = map_points;
 * scene.trajectory = trajectory;
 * pcl6d::TopView().write("top_view.png", scene);
 * \endcode
 * \ingroup visualization */
class TopView {
public:
  /** \throws BadArgument an option breaks its rule */
  explicit TopView(const TopViewOptions& options = TopViewOptions());

  /** \throws BadArgument neither a finite point nor a pose nor an overlay, no point of
   * several in the slice, or as MapCloud::validate()
   * \throws IoFailed there is no display to draw on */
  TopViewPicture
  draw(const TopViewScene& scene) const;

  /** \brief Draws into a PNG file, atomically. \return where things are on it
   * \throws BadArgument as draw() \throws IoFailed as draw(), or the file cannot be
   * written */
  TopViewLayout
  write(const std::filesystem::path& path, const TopViewScene& scene) const;

private:
  TopViewOptions options_;
};

} // namespace pcl6d
