// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/picture_settings.h"

#include <pcl6d/run/run_folder.h>
#include <pcl6d/visualization/map_view.h>
#include <pcl6d/visualization/top_view.h>

#include <map>
#include <optional>

namespace pcl6d::app {

/** \brief Draws the views of one run. Data shared by views is read once, on demand. */
class RunPictures {
public:
  /** Both are referred to, not copied. */
  RunPictures(const RunFolder& run, const PictureSettings& settings);

  /** \return whether a view of the name exists */
  static bool
  isView(const std::string& name);
  /** \return the names of the views, separated by commas */
  static std::string
  viewNames();
  /** \return a line per view with name and description, for --help */
  static std::string
  viewTable();

  /** \return the views suited to the run, in the order of the table */
  std::vector<std::string>
  suitableViews() const;

  /** \return a file of the run missing for a view, such as "planes.json"; empty if complete */
  std::string
  lackedBy(const std::string& view) const;

  /** \throws IoFailed, BadArgument drawing failed */
  Image
  draw(const std::string& view);

private:
  struct View;
  static const std::vector<View>&
  views();
  static const View&
  viewOf(const std::string& name);

  Image
  drawTop();
  Image
  drawPerspective();
  Image
  drawBeforeAfter();
  Image
  drawGraph();
  Image
  drawCovariance();
  Image
  drawSlice();
  Image
  drawPanorama();
  Image
  drawPlanes();
  Image
  drawObjects();
  Image
  drawConvergence();

  std::string
  title(const std::string& of) const;
  /** Of TopView or MapView. */
  template <typename Options>
  Options
  optionsOf(const std::string& of, PointColour usual) const
  {
    Options options;
    options.width = settings_.width.value_or(options.width);
    options.height = settings_.height;
    options.colour = settings_.colour.value_or(usual);
    options.colour_map = settings_.colour_map;
    options.background = settings_.background;
    options.transparent = settings_.transparent;
    options.title = title(of);
    options.max_points = settings_.points;
    return options;
  }
  MapCloud
  cloudFor(PointColour colour);
  const RunMap&
  map();
  MapCloud
  labelledCloud() const;
  MapCloud
  planeLabelledCloud() const;
  std::vector<ObjectPose>
  objects() const;
  Overlay
  roomOverlay() const;
  TopViewScene
  topScene(PointColour colour);
  MapViewScene
  mapScene(PointColour colour);
  Camera
  chosenCamera(const MapView& view, const MapViewScene& scene) const;
  std::size_t
  placeOf(int scan) const;
  std::size_t
  mostCorrected() const;
  TopViewScene
  sceneBefore(const TopViewScene& after, PointColour colour);

  const RunFolder& run_;
  const PictureSettings& settings_;
  std::optional<RunMap> map_;
  std::map<int, std::size_t> places_; ///< of the scans, by index
};

} // namespace pcl6d::app
