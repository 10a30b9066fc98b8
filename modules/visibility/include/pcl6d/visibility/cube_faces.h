// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/** \file The six faces of the cube on which a RayImage is stored. Faces 2 k and 2 k + 1 look along
 * axis k and against axis k; columns run along the next axis, rows along the previous axis
 * (cyclic). */
namespace pcl6d::visibility {

/** \brief Ranges measured in a cell, as codes that increase with the range. Empty: nearest 0. */
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

/** \brief Cells row by row, with equal numbers of rows and columns; empty: nothing was measured. */
using Faces = std::array<std::vector<Interval>, 6>;

/** \brief A direction by its position on the faces, in [-1, 1] along columns and rows. */
struct OnCube {
  std::size_t face;
  float u, v;
};

/** \brief A ray by direction and range. */
struct CodedRay {
  OnCube direction;
  std::uint16_t code;
};

/** \param[in] ray [m] not zero \return the intersection with the cube */
PCL6D_EXPORTS OnCube
onCube(const Eigen::Vector3f& ray);

/** \param[in] side cells along an edge of a face
 * \return the number of the cell on its face, row by row */
PCL6D_EXPORTS std::size_t
cellOf(const OnCube& place, int side);

/** \brief Dilation by a square of three cells, across the edges of the cube.
 * \param[in] side cells along an edge of a face
 * \param[in] filled a cell is empty unless at least this number of the nine cells (eight at a
 * corner of the cube) has measurements
 * \param[in] enclosed a cell is also empty unless each of its four sides has measurements
 * \return for each cell of a face the ranges measured in and around the cell; empty for a face
 * without cells */
PCL6D_EXPORTS std::vector<Interval>
haloOf(const Faces& measured,
       std::size_t face,
       int side,
       int filled,
       bool enclosed = false);

} // namespace pcl6d::visibility
