// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visualization/image.h>
#include <pcl6d/visualization/top_view.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief One panel: a share for every place of the grid. */
struct ConvergencePanel {
  std::string title;
  std::vector<double> shares; ///< in [0, 1], x runs fastest; NaN: not measured
};

/** \brief What is to be seen: panels over the same grid of offsets. */
struct ConvergenceMapScene {
  std::string title;
  std::string share_label = "correct runs"; ///< what the colours are a share of
  std::vector<double> x; ///< [m] evenly spaced, ascending; one at least
  std::vector<double> y; ///< [m] the same
  std::vector<ConvergencePanel> panels;
};

/** \brief Knobs of ConvergenceMap. */
struct ConvergenceMapOptions {
  int panel_width = 260; ///< [px] of the cells of a panel; 100 to 2000
  int columns = 0;       ///< panels in a row; 0: by their number; the picture must stay
                         ///< within 8192 pixels
  Background background = Background::kLight;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Where things are on a convergence map. \ingroup visualization */
struct ConvergenceMapLayout {
  int width = 0;  ///< [px] of the picture
  int height = 0; ///< [px]
  int columns = 1;
  double text_size = 15;          ///< [px]
  std::vector<PictureBox> panels; ///< their cells
  PictureBox colour_bar;
  Eigen::Vector2d low{0, 0};   ///< [m] x, y at the lower left corner of a panel
  double metres_per_pixel = 1; ///< the same in x and y, and in all panels

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

/** \brief Heat maps over offsets in x and y (book 4.2): from where ICP finds back to the
 * best pose, which is the ring in the middle.
 *
 * x to the right, y up, the same scale for both. A cell stands for one offset: dark
 * violet where no run is correct, yellow where all are. Drawn by VTK on the
 * PrivateDisplay. \ingroup visualization */
class ConvergenceMap {
public:
  /** \throws BadArgument an option breaks its rule */
  explicit ConvergenceMap(
      const ConvergenceMapOptions& options = ConvergenceMapOptions());

  /** \throws BadArgument there is no panel or no offset, offsets do not ascend, a panel
   * has not one share per place of the grid, or a share outside [0, 1]; the picture would
   * be too large
   * \throws IoFailed there is no display to draw on */
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
