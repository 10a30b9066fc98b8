// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Ground with slopes and hills over a rectangle. */
struct TerrainOptions {
  Eigen::Vector2d low = {-50, -50}; ///< [m] corner of the rectangle
  Eigen::Vector2d high = {50, 50};  ///< [m] the opposite corner, > low
  double cell = 1;                  ///< [m] largest side of a cell of the grid, > 0
  double height = 0;                ///< [m] at the origin, without hills
  Eigen::Vector2d slope = {0, 0};   ///< [m/m] rise along x and y
  double amplitude = 1;             ///< [m] hills reach at most so far up and down
  double wavelength = 40;           ///< [m] of the largest hills, > 0
  std::uint64_t seed = 1;           ///< same seed, same hills

  /** A terrain, or all of a scene file, may have so many cells: 190 MB; 1.4 km x 1.4 km of 1 m. */
  static constexpr double kMostCells = 2e6;

  /** \return of how many cells its grid is; infinite, or NaN, for options that break a rule */
  double
  numCells() const;

  /** \throws BadArgument naming the first field that breaks its rule, with its value;
   * more than kMostCells are refused before memory is taken */
  void
  validate() const;
};

/** \brief Heights on a regular grid, each cell two triangles. \ingroup simulation */
class Terrain {
public:
  /** \throws BadArgument see TerrainOptions::validate() */
  explicit Terrain(const TerrainOptions& options);

  /** \return the height [m] of the triangle at a place; beyond the rim that of the
   * nearest place on it */
  double
  height(const Eigen::Vector2d& place) const;

  /** \return the pose of a thing that stands there, its z axis square to the ground, its
   * x axis above the heading \param[in] yaw [rad] heading in plan */
  Eigen::Isometry3d
  poseOn(const Eigen::Vector2d& place, double yaw) const;

  /** \brief Adds the ground as one surface, seen from above. */
  void
  addTo(TriangleScene& scene, const Surface& material) const;

private:
  std::size_t
  index(std::size_t column, std::size_t row) const
  {
    return row * columns_ + column;
  }

  TerrainOptions options_;
  std::size_t columns_, rows_; // of vertices
  Eigen::Vector2d step_;       // [m] between them
  std::vector<double> heights_;
};

} // namespace pcl6d
