// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visualization/image.h>
#include <pcl6d/visualization/top_view.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief One panel: a share for every cell of the grid. */
struct ConvergencePanel {
  std::string title;
  std::vector<double> shares; ///< in [0, 1], x runs fastest; NaN: not measured
};

/** \brief Content of a convergence map: panels over one grid of offsets. */
struct ConvergenceMapScene {
  std::string title;
  std::string share_label = "correct runs"; ///< quantity of the colour bar
  std::vector<double> x;                    ///< [m] evenly spaced, ascending; not empty
  std::vector<double> y;                    ///< [m] the same
  std::vector<ConvergencePanel> panels;
};

/** \brief Options of ConvergenceMap. */
struct ConvergenceMapOptions {
  int panel_width = 260; ///< [px] of the cells of a panel; 100 to 2000
  int columns = 0;       ///< panels in a row; 0: by their number; the picture must stay
                         ///< within 8192 pixels
  Background background = Background::kLight;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Layout of a convergence map. \ingroup visualization */
struct ConvergenceMapLayout {
  int width = 0;  ///< [px] of the picture
  int height = 0; ///< [px]
  int columns = 1;
  double text_size = 15;          ///< [px]
  std::vector<PictureBox> panels; ///< their cells
  PictureBox colour_bar;
  Eigen::Vector2d low{0, 0};   ///< [m] x, y at the lower left corner of a panel
  double metres_per_pixel = 1; ///< equal in x and y, and for every panel

  /** \return column and row of an offset [m] in a panel */
  Eigen::Vector2d
  toPixel(std::size_t panel, const Eigen::Vector2d& offset) const
  {
    const Eigen::Vector2d way = (offset - low) / metres_per_pixel;
    return {panels[panel].left + way.x(), panels[panel].bottom - way.y()};
  }
};

struct ConvergenceMapPicture {
  Image image;
  ConvergenceMapLayout layout;
};

/** \brief Heat maps over offsets in x and y (book 4.2): the offsets from which ICP
 * finds the best pose, marked by the ring in the middle.
 *
 * x to the right, y up, with equal scale. A cell stands for one offset: dark violet for
 * no correct run, yellow for only correct runs. Drawn by VTK on the PrivateDisplay.
 * \ingroup visualization */
class ConvergenceMap {
public:
  /** \throws BadArgument an option is invalid */
  explicit ConvergenceMap(
      const ConvergenceMapOptions& options = ConvergenceMapOptions());

  /** \throws BadArgument no panel or no offset, offsets not ascending, a panel without
   * one share per cell of the grid, a share outside [0, 1], or a picture too large
   * \throws IoFailed no display */
  ConvergenceMapPicture
  draw(const ConvergenceMapScene& scene) const;

  /** \brief Draws into a PNG file, atomically.
   * \throws BadArgument as draw() \throws IoFailed as draw(), or the file cannot be
   * written */
  ConvergenceMapLayout
  write(const std::filesystem::path& path, const ConvergenceMapScene& scene) const;

private:
  ConvergenceMapOptions options_;
};

} // namespace pcl6d
