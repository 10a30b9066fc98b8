// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/animation_settings.h"

#include <pcl6d/io/frames_io.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/visualization/map_view.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The frames of a run's film. */
class RunAnimation {
public:
  /** \param[in] run, settings kept by reference, not copied
   * \throws IoFailed the run lacks data for the film, or a file is broken */
  RunAnimation(const RunFolder& run, const AnimationSettings& settings);

  std::size_t
  size() const
  {
    return frames_.size();
  }

  /** \throws IoFailed drawing failed */
  Image
  draw(std::size_t frame) const;

private:
  /** Points with a common motion: of a scan, in its frame, or of the map, in the world. */
  struct Part {
    Points points;
    std::uint32_t scan = 0; ///< index
  };
  struct Frame {
    std::vector<Eigen::Isometry3d>
        poses; ///< of the first parts; further parts are hidden
    Trajectory path;
    Camera camera;
    std::string title;
  };

  void
  tellTurntable();
  void
  tellFlyThrough();
  void
  tellGrowth();
  void
  tellRelaxation();
  std::vector<std::vector<pcl6d::Frame>>
  readHistory() const;
  void
  readScans(const std::vector<Eigen::Isometry3d>& poses, const HeightCut& cut);
  Frame
  readMap(const HeightCut& cut);
  MapViewScene
  sceneOf(const Frame& frame) const;

  const RunFolder& run_;
  const AnimationSettings& settings_;
  MapViewOptions view_;
  std::vector<Part> parts_;
  std::vector<Frame> frames_;
};

} // namespace pcl6d::app
