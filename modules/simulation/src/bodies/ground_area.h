// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <vector>

/** \file The area around the places of a scanner, in cells. */
namespace pcl6d::simulation {

constexpr double kBodyHeight = 2; // [m] free height required above a floor
constexpr double kSteepest = 0.2; // of floors: twice a wheelchair ramp's
constexpr double kNoFloor = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostCells = 1e7; // 200 to 300 MB

/** \brief A rectangle of square cells. */
struct GroundArea {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(); // [m]
  double cell = 0.1;                             // [m]
  std::size_t columns = 0, rows = 0;

  std::size_t
  size() const
  {
    return columns * rows;
  }

  /** \return the cell at a position; size() outside */
  std::size_t
  at(const Eigen::Vector2d& place) const;

  /** \return the middle of a cell [m] */
  Eigen::Vector2d
  middle(std::size_t i) const;

  /** \return the cell dx columns and dy rows on; size() outside */
  std::size_t
  neighbour(std::size_t i, int dx, int dy) const;
};

/** \brief The area within reach of the places.
 * \param[in] cell [m] \throws BadArgument no place, a non-finite place, or reach is not
 * in (0, 1000] m \throws ComputeFailed more than 10 million cells */
GroundArea
areaAround(const std::vector<Eigen::Vector3d>& places, double reach, double cell);

/** \return for each cell whether a place is within reach; reach is up to 5 % too short
 * where places are close to each other */
std::vector<char>
withinReach(const GroundArea& area,
            const std::vector<Eigen::Vector3d>& places,
            double reach);

} // namespace pcl6d::simulation
