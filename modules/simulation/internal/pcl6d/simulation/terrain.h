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
  double amplitude = 1;             ///< [m] largest deviation of hills up and down
  double wavelength = 40;           ///< [m] of the largest hills, > 0
  std::uint64_t seed = 1;           ///< equal seeds give equal hills

  /** Largest number of cells of a terrain, or of the terrains of a scene file: 190 MB;
   * 1.4 km x 1.4 km with cells of 1 m. */
  static constexpr double kMostCells = 2e6;

  /** \return the number of cells of the grid; infinite, or NaN, for invalid options */
  double
  numCells() const;

  /** \throws BadArgument naming the first invalid field and its value; more than
   * kMostCells are refused before memory is allocated */
  void
  validate() const;
};

/** \brief Heights on a regular grid, each cell two triangles. \ingroup simulation */
class Terrain {
public:
  /** \throws BadArgument see TerrainOptions::validate() */
  explicit Terrain(const TerrainOptions& options);

  /** \return the height [m] at a position; beyond the rim the height of the nearest
   * position on the rim */
  double
  height(const Eigen::Vector2d& place) const;

  /** \return the pose of an object on the ground, its z axis normal to the ground, its
   * x axis above the heading \param[in] yaw [rad] heading in plan */
  Eigen::Isometry3d
  poseOn(const Eigen::Vector2d& place, double yaw) const;

  /** \brief Adds the ground as one surface, visible from above. */
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
  Eigen::Vector2d step_;       // [m] between vertices
  std::vector<double> heights_;
};

} // namespace pcl6d
