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
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit, of arbitrary sign
  double variance = 0;                              ///< [m^2] of the points
                                                    ///< across the plane
  std::size_t number = 0; ///< of its cell; constant until forgetBeyond()
};

/** \brief Knobs of SurfaceMap. */
struct SurfaceMapOptions {
  double cell = 0.25; ///< [m] edge of the smallest cells; finite, > 0
  int levels = 4;     ///< of cells, each level twice as large; in [1, 8]
  /** least ratio of the smaller spread of points along the plane of a flat cell to the
   * spread across; > 1 */
  double flatness = 5;
  /** most points of one call of add() that count in a cell, since they share the error of their
   * scan's pose; >= 1 */
  double points_of_scan = 20;
  /** most points that count in a cell: beyond, older points fade away; infinite: no limit */
  double points_of_cell = 200;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Map of planes in cells of several sizes, built scan by scan.
 *
 * Each cell holds sums over its points, hence their mean and spread, and is a plane if flat. A
 * position belongs to the largest surrounding cell that is not thicker than the smaller cells
 * within: a wall is one large and exact plane, furniture many small planes. Points far off a
 * surface still share a large cell with the surface, hence matching has a wide basin. \note Source:
 * like the adaptive voxels of C. Yuan et al., "Efficient and probabilistic adaptive voxel mapping",
 * RA-L 2022, but with sums on every level in place of an octree. \ingroup deskew */
class SurfaceMap {
public:
  /** \throws BadArgument an option is invalid */
  explicit SurfaceMap(const SurfaceMapOptions& options = {});

  /** \brief Adds the points of a scan [m, world]; points that are not finite are left out.
   * \throws BadArgument a point lies outside the grid (voxelKey()) */
  void
  add(const std::vector<Eigen::Vector3d>& points);

  /** \brief Drops the cells with a centre farther than a distance [m] from a place. */
  void
  forgetBeyond(const Eigen::Vector3d& place, double distance);

  /** \return the plane at a place, valid until the map changes; null: no plane. Safe to call from
   * several threads */
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
    Sums fresh; ///< of the scan being added
    bool is_flat = false;
    SurfacePlane plane; ///< of a flat cell
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
