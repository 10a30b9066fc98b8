// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/image.h>
#include <pcl6d/visualization/top_view_layout.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pcl6d::test {

/** \return the largest difference of a channel */
inline int
difference(const Colour& a, const Colour& b)
{
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(int{a[i]} - int{b[i]}));
  return largest;
}

inline Colour
colourAt(const Image& image, const Eigen::Vector2d& pixel)
{
  return image.at(static_cast<int>(std::floor(pixel.x())),
                  static_cast<int>(std::floor(pixel.y())));
}

/** \return how near a colour comes to the given one within a few pixels of a place */
inline int
nearestDifference(const Image& image,
                  const Eigen::Vector2d& pixel,
                  const Colour& wanted,
                  int reach = 2)
{
  int best = 255;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      best = std::min(
          best, difference(colourAt(image, pixel + Eigen::Vector2d(dx, dy)), wanted));
  return best;
}

/** \return the number of pixels in a box that differ from a colour */
inline int
drawnPixels(const Image& image, const PictureBox& box, const Colour& background)
{
  int count = 0;
  for (int row = static_cast<int>(box.top); row < static_cast<int>(box.bottom); ++row)
    for (int column = static_cast<int>(box.left); column < static_cast<int>(box.right);
         ++column)
      count += difference(image.at(column, row), background) > 60;
  return count;
}

constexpr Colour kDarkBackground{12, 13, 18};
constexpr Colour kWhite{255, 255, 255};

} // namespace pcl6d::test
