// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A rectangle of pixels; columns from the left, rows from the top. */
struct PictureBox {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;

  bool
  contains(const Eigen::Vector2d& pixel) const
  {
    return pixel.x() >= left && pixel.x() <= right && pixel.y() >= top &&
           pixel.y() <= bottom;
  }
};

/** \brief Layout of a top view. \ingroup visualization */
struct TopViewLayout {
  int width = 0;                ///< [px] of the picture
  int height = 0;               ///< [px]
  PictureBox map;               ///< contains the whole map
  double metres_per_pixel = 1;  ///< equal in x and y
  Eigen::AlignedBox2d area;     ///< [m] visible part of the world
  Eigen::Vector2d centre{0, 0}; ///< [m] world x, y in the middle of the map's box
  double scale_bar_metres = 1;  ///< 1, 2 or 5 times a power of ten
  Eigen::Vector2d scale_bar_begin{0, 0}; ///< [px] left end
  Eigen::Vector2d scale_bar_end{0, 0};   ///< [px] right end
  double text_size = 12;                 ///< [px]
  double lowest_colour = 0;              ///< value at the lower end of the colours
  double highest_colour = 0;             ///< the same at the upper end
  bool ceiling_hidden = false;
  std::size_t points_drawn = 0;

  /** \return column and row of a position in the world [m]; pixel (c, r) spans (c, r)
   * to (c + 1, r + 1) */
  Eigen::Vector2d
  toPixel(const Eigen::Vector2d& world) const
  {
    const Eigen::Vector2d offset = (world - centre) / metres_per_pixel;
    return {0.5 * (map.left + map.right) + offset.x(),
            0.5 * (map.top + map.bottom) - offset.y()};
  }
};

} // namespace pcl6d
