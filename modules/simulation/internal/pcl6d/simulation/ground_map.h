// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Map of free floor where bodies can stand and walk.
 *
 * Square cells in the x-y plane, z up, with one floor per cell. \ingroup simulation */
class GroundMap {
public:
  /** \brief Floor heights in square cells. */
  struct Raster {
    Eigen::Vector2d low = Eigen::Vector2d::Zero(); ///< [m] corner of cell 0
    double cell = 0.1;                             ///< [m] edge of a cell, > 0
    std::size_t columns = 0;                       ///< along x
    std::size_t rows = 0;                          ///< along y
    std::vector<double> floors; ///< [m] row by row; NaN: occupied or unknown
  };

  /** \throws BadArgument a field is invalid, or not one floor per cell */
  explicit GroundMap(Raster raster);

  const Raster&
  raster() const
  {
    return raster_;
  }

  /** \return the height of the floor [m], interpolated between the middles of cells;
   * nullopt where a body cannot stand */
  std::optional<double>
  floor(const Eigen::Vector2d& place) const;

  /** \return the radius [m] of the largest disc of free floor about a position; 0
   * without one. Too small by up to 1.5 cells */
  double
  room(const Eigen::Vector2d& place) const;

  /** \return whether a disc can go straight between two positions \param[in] radius
   * [m] */
  bool
  isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius) const;

  /** \brief A short way for a disc between two positions, of straight legs.
   * \param[in] from, to ends of the way [m]
   * \param[in] radius of the disc [m] \param[in] longest [m] limit for the way
   * \return its corners, both ends included; empty if no way is short enough
   * \note Source: P. E. Hart, N. J. Nilsson, B. Raphael, "A formal basis for the
   * heuristic determination of minimum cost paths", IEEE Trans. Systems Science and
   * Cybernetics 4(2), 1968; then corners are left out where the way stays free */
  std::vector<Eigen::Vector2d>
  way(const Eigen::Vector2d& from,
      const Eigen::Vector2d& to,
      double radius,
      double longest) const;

private:
  struct Search;

  std::optional<std::size_t>
  cellAt(const Eigen::Vector2d& place) const;
  Eigen::Vector2d
  middle(std::size_t cell) const;
  double
  roomOf(std::size_t cell) const;

  Raster raster_;
  std::vector<float>
      gaps_; // [m] from the middle of a cell to the middle of the next occupied cell
};

} // namespace pcl6d
