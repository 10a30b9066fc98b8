// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Accumulator over directions in cells of nearly equal solid angle, for votes
 * on normals.
 *
 * Each pole has one round cell, so floors and ceilings fall into one cell, not a wreath
 * of wedges. In between, slices of equal height in angle are cut into cells of nearly
 * equal width. The largest cell is at most 1.10 times the smallest.
 * \note Source: D. Borrmann, J. Elseberg, K. Lingemann, A. Nüchter, "The 3D Hough
 * transform for plane detection in point clouds: a review and a new accumulator
 * design", 3D Research 2(2), 2011; without the round cells. Book: 7.1.1.
 * \ingroup plane_segmentation */
class AccumulatorBall {
public:
  /** \param[in] slices between the poles, in [2, 1000]: a cell is about pi / slices
   * wide
   * \throws BadArgument slices is out of range */
  explicit AccumulatorBall(int slices = 45);

  /** \return the number of cells */
  std::size_t
  size() const
  {
    return first_.back() + 1;
  }

  /** \return the cell of a direction. \param[in] direction unit length */
  std::size_t
  cellOf(const Eigen::Vector3d& direction) const;

  /** \return the direction in the middle of a cell, unit length */
  Eigen::Vector3d
  centre(std::size_t cell) const;

  /** \return the solid angle of a cell [sr] */
  double
  area(std::size_t cell) const;

  /** \return the cells that touch a cell, also at a corner, ascending */
  std::vector<std::size_t>
  neighbours(std::size_t cell) const;

  /** \return the cells within a number of steps from neighbour to neighbour, itself
   * included, ascending */
  std::vector<std::size_t>
  window(std::size_t cell, int steps) const;

private:
  struct Place {
    std::size_t slice; ///< 0 and the last: a pole
    std::size_t index; ///< in the slice
  };

  Place
  placeOf(std::size_t cell) const;
  std::size_t
  width(std::size_t slice) const
  {
    return slice + 1 < first_.size() ? first_[slice + 1] - first_[slice] : 1;
  }
  void
  appendTouching(const Place& place,
                 std::size_t slice,
                 std::vector<std::size_t>& cells) const;

  double cap_;                     // [rad] half angle of a cell at a pole
  double height_;                  // [rad] of a slice
  std::vector<std::size_t> first_; // cell of each slice, poles included
};

} // namespace pcl6d
