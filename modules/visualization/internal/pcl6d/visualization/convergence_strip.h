// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/visualization/map_cloud.h>
#include <pcl6d/visualization/top_view_layout.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief One step in the registration of a scan. */
struct ConvergenceStep {
  std::string title;   ///< "odometry"
  std::string caption; ///< "0.43 m, 2.1 deg off"; may be empty
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  Points fixed; ///< points of the target scans at this step [m]
};

/** \brief Content of a convergence strip. */
struct ConvergenceStripScene {
  std::string title;
  Points scan; ///< points in the scan's frame [m]
  std::vector<ConvergenceStep> steps;
};

/** \brief Options of ConvergenceStrip. */
struct ConvergenceStripOptions {
  int width = 1600; ///< [px] of the picture; 400 to 8192
  int columns = 0;  ///< panels in a row; 0: up to four
  Background background = Background::kDark;
  bool transparent = false; ///< in place of the background
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Layout of a convergence strip. */
struct ConvergenceStripLayout {
  int width = 0;  ///< [px]
  int height = 0; ///< [px]
  int columns = 1;
  double text_size = 15; ///< [px]
  std::vector<PictureBox> panels;
  Eigen::Vector2d centre{0, 0}; ///< [m] of the world in the middle of each panel
  double metres_per_pixel = 1;  ///< equal for every panel

  /** \return column and row of a position [m] on a panel */
  Eigen::Vector2d
  toPixel(std::size_t panel, const Eigen::Vector2d& world) const
  {
    const PictureBox& box = panels[panel];
    const Eigen::Vector2d offset = (world - centre) / metres_per_pixel;
    return {0.5 * (box.left + box.right) + offset.x(),
            0.5 * (box.top + box.bottom) - offset.y()};
  }
};

struct ConvergenceStripPicture {
  Image image;
  ConvergenceStripLayout layout;
};

/** \brief Registration of a scan in steps: one panel per step, from above, the scan in
 * orange over the target scans in grey. \ingroup visualization */
class ConvergenceStrip {
public:
  /** \throws BadArgument an option is invalid */
  explicit ConvergenceStrip(
      const ConvergenceStripOptions& options = ConvergenceStripOptions());

  /** \throws BadArgument no step, a scan without a finite point, or too many steps for
   * a picture of 8192 px in height
   * \throws IoFailed no display */
  ConvergenceStripPicture
  draw(const ConvergenceStripScene& scene) const;

private:
  ConvergenceStripOptions options_;
};

} // namespace pcl6d
