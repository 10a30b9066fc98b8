// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/voxel_numbers.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The plane through the points of a cell. */
struct SurfacePlane {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();   ///< [m] of the points
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit; its sign is arbitrary
  double variance = 0;                              ///< [m^2] of the points across it
  std::size_t number = 0; ///< of its cell; stays as long as nothing is forgotten
};

/** \brief Knobs of SurfaceMap. */
struct SurfaceMapOptions {
  double cell = 0.25; ///< [m] edge of the smallest cells; finite, > 0
  int levels = 4;     ///< of cells, each twice as large; in [1, 8]
  /** a cell is flat if its points spread so many times farther along its plane, in the
   * direction in which they do least, than across; > 1 */
  double flatness = 5;
  /** so many points of one call of add() count in a cell, as they share the error of their
   * scan's pose; >= 1 */
  double points_of_scan = 20;
  /** so many points count in a cell: beyond, older ones fade away; infinite: all count */
  double points_of_cell = 200;
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief A map that grows scan by scan: planes in cells of several sizes.
 *
 * Each cell holds sums over its points, hence their mean and spread, and is a plane if it
 * is flat. A place belongs to the largest cell around it that is not thicker than the
 * smaller ones within it: a wall is one large and exact plane, furniture is many small
 * ones. Points far off a surface still lie in a large cell with it, so matching has a
 * wide basin. \note Source: like the adaptive voxels of C. Yuan et al., "Efficient and
 * probabilistic adaptive voxel mapping", RA-L 2022, but with sums on every level in place
 * of an octree. \ingroup registration */
class SurfaceMap {
public:
  /** \throws BadArgument an option breaks its rule */
  explicit SurfaceMap(const SurfaceMapOptions& options = {});

  /** \brief Adds the points of a scan [m, world]; those that are not finite do not count.
   * \throws BadArgument a point lies outside the grid (voxelKey()) */
  void
  add(const std::vector<Eigen::Vector3d>& points);

  /** \brief Drops the cells whose centre is farther [m] from a place. */
  void
  forgetBeyond(const Eigen::Vector3d& place, double distance);

  /** \return the plane that a place belongs to, valid until the map changes; null: none.
   * Safe to call from several threads */
  const SurfacePlane*
  planeAt(const Eigen::Vector3d& place) const;

  /** \return the number of occupied cells of the smallest size */
  std::size_t
  size() const
  {
    return levels_.front().cells.size();
  }

  const SurfaceMapOptions&
  options() const
  {
    return options_;
  }

private:
  /** Sums over points, as offsets from the centre of their cell [m]. */
  struct Sums {
    double count = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  };
  struct Cell {
    VoxelKey key = 0;
    Sums sums;
    Sums fresh; ///< of the scan that is being added
    bool is_flat = false;
    SurfacePlane plane; ///< of a flat one
  };
  struct Level {
    double edge = 0; ///< [m]
    std::size_t index = 0;
    VoxelNumbers numbers;
    std::vector<Cell> cells;
  };

  static Cell&
  cellOf(const Eigen::Vector3d& place, Level& level, std::vector<std::size_t>& touched);
  void
  takeFresh(Cell& cell, double edge) const;
  void
  findPlane(Cell& cell, double edge) const;
  static void
  shift(const Sums& from, const Eigen::Vector3d& offset, Sums& to);

  SurfaceMapOptions options_;
  std::vector<Level> levels_; ///< the smallest cells first
};

} // namespace pcl6d
