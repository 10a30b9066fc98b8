// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/image.h>
#include <pcl6d/visualization/top_view_layout.h>

#include <cstdint>
#include <optional>
#include <string>

namespace pcl6d {

/** \brief What the colour of a map point tells. \ingroup visualization */
enum class PointColour {
  kHeight, ///< z, from its 2 % to its 98 % quantile
  kScan    ///< index of the scan, from first to last
};

enum class Background { kDark, kLight };

/** \brief Knobs of TopView; the defaults suit maps of a room as well as of a campus. */
struct TopViewOptions {
  int width = 1600;          ///< [px] 200 to 8192
  std::optional<int> height; ///< [px] 200 to 8192; by default follows the map's shape
  int margin = 24;           ///< [px] around everything; 0 to width / 8
  PointColour colour = PointColour::kHeight;
  Background background = Background::kDark;
  std::string title;                    ///< top left; may be empty
  std::string final_label = "after";    ///< of the trajectory, in the legend
  std::string initial_label = "before"; ///< of the initial trajectory
  std::optional<double> point_size;     ///< [px] > 0; by default closes the gaps
  std::size_t max_points = 4000000; ///< more are thinned evenly, always the same; > 0
  /** [m] points above are left out; by default, if the map has a ceiling, what is
   * higher than cut_above_trajectory above the nearest pose; infinity: draw all */
  std::optional<double> max_height;
  double cut_above_trajectory = 0.5; ///< [m] see max_height

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What is to be seen. */
struct TopViewScene {
  Points points;                    ///< the map in the world [m]; NaN is skipped
  std::vector<std::uint32_t> scans; ///< index of each point's scan, or empty
  Trajectory trajectory;            ///< final poses, or empty
  Trajectory initial;               ///< poses before the run, or empty
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
 * is found (see TopViewOptions::max_height) and cut away.
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

  /** \throws BadArgument no finite point, as many scan indices as points neither nor
   * none, or colour by scan without scan indices
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
