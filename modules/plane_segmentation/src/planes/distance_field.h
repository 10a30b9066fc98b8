// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief A raster of width columns and height rows, row by row. */
template <typename T>
struct Raster {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<T> cells;

  Raster(std::size_t columns, std::size_t rows, T value)
  : width(columns), height(rows), cells(columns * rows, value)
  {}

  T&
  at(std::size_t x, std::size_t y)
  {
    return cells[y * width + x];
  }

  const T&
  at(std::size_t x, std::size_t y) const
  {
    return cells[y * width + x];
  }
};

/** \brief The exact distance between the centres of each cell and the nearest cell of a
 * set [cells]; very large for an empty set. \note Source: P. F. Felzenszwalb, D. P.
 * Huttenlocher, "Distance transforms of sampled functions", Theory of Computing 8,
 * 2012. */
Raster<float>
distanceField(const Raster<char>& set);

} // namespace pcl6d::plane_segmentation
