// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/** \file The six faces of the cube that a RayImage is kept on. Faces 2 k and 2 k + 1 look along
 * axis k and against it; columns run along the axis after it, rows along the one before. */
namespace pcl6d::visibility {

/** \brief Ranges measured in a cell, as codes that grow with the range. Empty: nearest 0. */
struct Interval {
  std::uint16_t nearest = 0;
  std::uint16_t farthest = 0;

  bool
  isEmpty() const
  {
    return nearest == 0;
  }
  /** \param[in] code of a range, > 0 */
  void
  add(std::uint16_t code)
  {
    nearest = isEmpty() ? code : std::min(nearest, code);
    farthest = std::max(farthest, code);
  }
};

/** \brief Cells row by row, as many rows as columns; empty: nothing was measured there. */
using Faces = std::array<std::vector<Interval>, 6>;

/** \brief A direction by its place on the faces, in [-1, 1] along columns and rows. */
struct OnCube {
  std::size_t face;
  float u, v;
};

/** \brief A ray by its direction and its range. */
struct CodedRay {
  OnCube direction;
  std::uint16_t code;
};

/** \param[in] ray [m] not zero \return where it meets the cube */
PCL6D_EXPORTS OnCube
onCube(const Eigen::Vector3f& ray);

/** \param[in] side cells along an edge of a face
 * \return the number of the cell on its face, row by row */
PCL6D_EXPORTS std::size_t
cellOf(const OnCube& place, int side);

/** \brief Dilation by a square of three cells, across the edges of the cube.
 * \param[in] side cells along an edge of a face
 * \param[in] filled a cell is empty unless so many of the nine (at a corner of the cube of
 * the eight) are not
 * \param[in] enclosed a cell is also empty unless something was measured on each of its four
 * sides
 * \return for each cell of a face what was measured in it and around it; none for a face
 * without cells */
PCL6D_EXPORTS std::vector<Interval>
haloOf(const Faces& measured,
       std::size_t face,
       int side,
       int filled,
       bool enclosed = false);

} // namespace pcl6d::visibility
