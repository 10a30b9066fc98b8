// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/pixel_scene.h"
#include "drawing/point_paint.h"
#include "drawing/theme.h"

#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/overlay.h>
#include <pcl6d/visualization/top_view_layout.h>

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace pcl6d::visualization {

/** \brief Annotations on a picture of a map: paths, overlay, title, legend, scale bar
 * and colour bar. */
class Annotations {
public:
  /** \return column and row of a position in the world; empty: outside the picture */
  using Project = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector3d&)>;

  struct Frame {
    int width = 0; ///< [px]
    int height = 0;
    double margin = 24;    ///< [px] around everything
    double text_size = 18; ///< [px]
  };

  struct Paths {
    const Trajectory& initial;
    const Trajectory& final;
    std::string initial_label = "before";
    std::string final_label = "after";
  };

  /** The scene and the function are referred to, not copied. */
  Annotations(PixelScene& scene,
              const Frame& frame,
              Background background,
              const Project& project);

  /** \brief The paths, each with a ring at its start. */
  void
  addPaths(const Paths& paths);
  void
  addOverlay(const Overlay& overlay);
  void
  addTitle(const std::string& title);
  /** \brief Keys of the paths and further keys; to be called after the title. */
  void
  addLegend(const Paths& paths, const std::vector<Overlay::Key>& keys);
  void
  addScaleBar(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, double metres);
  /** \brief The colour bar, or the names of the colours. */
  void
  addColours(const ColourScale& scale);

private:
  std::optional<Eigen::Vector2d>
  pixelOf(const Eigen::Vector3d& place) const;
  void
  addPath(const Trajectory& trajectory, const Colour& colour, double layer);
  void
  addStartRing(const Eigen::Vector2d& place, const Colour& colour);
  void
  addLines(const std::vector<Overlay::Line>& lines);
  void
  addColourBar(const ColourScale& scale);
  void
  addColourNames(const ColourScale& scale);
  void
  addText(const Eigen::Vector2d& place,
          const std::string& text,
          PixelScene::Align align,
          const PixelScene::Pen& pen);
  Eigen::Vector2d
  addLegendText(const std::string& label, double room);
  void
  addLegendEntry(const std::string& label, const Colour& colour);
  std::vector<PixelScene::Polyline>
  visibleParts(const std::vector<Eigen::Vector3d>& places) const;
  PixelScene::Pen
  text() const;
  double
  topRow() const;
  double
  bottomRow() const;
  /** \return a length [px] in proportion to the size of the picture */
  double
  scaled(double length) const;

  PixelScene& scene_;
  Frame frame_;
  Theme theme_;
  const Project& project_;
  double title_end_ = 0;             ///< [px]
  Eigen::Vector2d legend_end_{0, 0}; ///< [px] right end of the next entry
};

/** \return the size of text [px] for a picture of the given width */
double
textSizeFor(int width);

/** \brief Adds every annotation of a picture of a map.
 * \param[in] layout of a top view, which has a scale bar, or of a map view */
template <typename Options, typename Scene, typename Layout>
void
annotate(const Options& options,
         const Scene& scene,
         const Layout& layout,
         const ColourScale& scale,
         const Annotations::Project& project,
         PixelScene& canvas)
{
  const Annotations::Frame frame = {layout.width,
                                    layout.height,
                                    static_cast<double>(options.margin),
                                    layout.text_size};
  static const Trajectory kNone;
  const Annotations::Paths paths = {options.draw_paths ? scene.initial : kNone,
                                    options.draw_paths ? scene.trajectory : kNone,
                                    options.initial_label,
                                    options.final_label};
  Annotations annotations(canvas, frame, options.background, project);
  annotations.addPaths(paths);
  annotations.addOverlay(scene.overlay);
  annotations.addTitle(options.title);
  std::vector<Overlay::Key> keys = scene.overlay.keys;
  if constexpr (std::is_same_v<Layout, TopViewLayout>)
    if (!scene.moving.empty())
      keys.push_back({"what moved", themeOf(options.background).moved});
  annotations.addLegend(paths, keys);
  if constexpr (std::is_same_v<Layout, TopViewLayout>)
    annotations.addScaleBar(
        layout.scale_bar_begin, layout.scale_bar_end, layout.scale_bar_metres);
  annotations.addColours(scale);
}

} // namespace pcl6d::visualization
