// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pixel_scene.h"
#include "top_view_points.h"

namespace pcl6d {

/** \brief Draws one top view; its methods add the parts one by one. */
class TopViewPainter {
public:
  /** Both are referred to, not copied. */
  TopViewPainter(const TopViewOptions& options, const TopViewLayout& layout);

  void
  addMap(const DrawnPoints& points);
  /** \brief The paths and a ring where they start. */
  void
  addTrajectories(const TopViewScene& scene);
  void
  addTitle();
  /** \brief Which path is which. */
  void
  addLegend(const TopViewScene& scene);
  void
  addScaleBar();
  void
  addColourBar();
  Image
  draw();

private:
  /** The colours of everything but the points. */
  struct Theme {
    Colour background; ///< also around the paths
    Colour text;
    Colour initial;
    Colour final;
  };

  static Theme
  themeOf(Background background);
  void
  addPath(const std::vector<Eigen::Vector2d>& path, const Colour& colour, double layer);
  void
  addStartRing(const Eigen::Vector2d& place, const Colour& colour);
  /** \return where the next entry to the left ends */
  double
  addLegendText(double right, const std::string& label);
  double
  addLegendEntry(double right, const std::string& label, const Colour& colour);
  PixelScene::Pen
  text() const;
  /** \return a length [px] that looks the same on pictures of any size */
  double
  scaled(double length) const;

  const TopViewOptions& options_;
  const TopViewLayout& layout_;
  Theme theme_;
  PixelScene scene_;
};

} // namespace pcl6d
