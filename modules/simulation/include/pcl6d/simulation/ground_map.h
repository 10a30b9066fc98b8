// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Where bodies can stand and go: floor without anything on it, seen from above.
 *
 * Square cells in the plane of x and y; z is up. One floor at each place. \ingroup
 * simulation */
class GroundMap {
public:
  /** \brief What a map is made of. */
  struct Raster {
    Eigen::Vector2d low = Eigen::Vector2d::Zero(); ///< [m] corner of cell 0
    double cell = 0.1;                             ///< [m] edge of a cell, > 0
    std::size_t columns = 0;                       ///< along x
    std::size_t rows = 0;                          ///< along y
    std::vector<double>
        floors; ///< [m] row by row; NaN: something stands there, or unknown
  };

  /** \throws BadArgument a field breaks its rule, or as many floors as cells are not there */
  explicit GroundMap(Raster raster);

  const Raster&
  raster() const
  {
    return raster_;
  }

  /** \return the height of the floor [m], between the middles of cells in between; none
   * where a body cannot stand */
  std::optional<double>
  floor(const Eigen::Vector2d& place) const;

  /** \return the radius [m] of a disc about the place that holds free floor only; 0 if
   * there is none. Too small by up to 1.5 cells */
  double
  room(const Eigen::Vector2d& place) const;

  /** \return whether a disc can go straight from one place to another \param[in] radius [m]
   */
  bool
  isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius) const;

  /** \brief A short way for a disc between two places, of straight legs.
   * \param[in] radius of the disc [m] \param[in] longest [m] of the ways that count
   * \return its corners, both ends included; none if there is no such way
   * \note Source: P. E. Hart, N. J. Nilsson, B. Raphael, "A formal basis for the heuristic
   * determination of minimum cost paths", IEEE Trans. Systems Science and Cybernetics 4(2),
   * 1968; then corners are left out where the way stays free */
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
      gaps_; // [m] from the middle of a cell to that of the next unfree one
};

} // namespace pcl6d
