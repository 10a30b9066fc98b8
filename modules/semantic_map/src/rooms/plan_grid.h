// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rooms/plan_walls.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <vector>

/** \file The plan of a storey in square cells. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \brief Cells of a plan; lines without width separate adjacent cells. Points are in
 * the frame of the grid: aligned with it, in metres. */
class PlanGrid {
public:
  static constexpr std::int32_t kOutside = -1;
  static constexpr std::int32_t kNoRoom = -2;

  /** \param[in] cell [m], increased to have at most 2^24 cells */
  PlanGrid(const Eigen::AlignedBox2d& bounds, double cell);

  double
  cell() const
  {
    return cell_;
  }
  std::size_t
  numCells() const
  {
    return labels_.size();
  }
  std::size_t
  columns() const
  {
    return columns_;
  }

  Eigen::Vector2d
  centre(std::size_t cell) const;

  /** \return the lower corner of a column and a row */
  Eigen::Vector2d
  corner(std::int64_t column, std::int64_t row) const;

  /** \return the part at a point, kOutside or kNoRoom */
  std::int32_t
  labelAt(const Eigen::Vector2d& point) const;

  std::int32_t
  label(std::size_t cell) const
  {
    return labels_[cell];
  }
  void
  setLabel(std::size_t cell, std::int32_t label)
  {
    labels_[cell] = label;
  }

  /** \brief Parts the cells on both sides of a line. */
  void
  addLine(const PlanLine& line);

  /** \brief Labels the connected parts of the cells with a true `inside`.
   * \return the number of parts */
  std::int32_t
  findParts(const std::function<bool(const Eigen::Vector2d&)>& inside);

  /** \return per part the side of its largest square [cells] */
  std::vector<std::size_t>
  largestSquares(std::int32_t num_parts) const;

  /** \return the outer border of a part, counter-clockwise, corners only */
  std::vector<Eigen::Vector2d>
  outline(std::int32_t part) const;

private:
  void
  fill(std::size_t start, std::int32_t part);

  Eigen::Vector2d origin_; ///< of the first cell
  double cell_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::int32_t> labels_;
  std::vector<bool> wall_right_; ///< between a cell and the next cell of its row
  std::vector<bool> wall_above_; ///< between a cell and the cell above
};

} // namespace pcl6d::semantic_map
