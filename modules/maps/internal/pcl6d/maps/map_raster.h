// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/maps/mapped_scan.h>

#include <Eigen/Geometry>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Square cells over the ground of a map, seen from above. */
struct MapRaster {
  double resolution = 0.1;                          ///< [m] edge of a cell
  Eigen::Vector2d corner = Eigen::Vector2d::Zero(); ///< [m] least x and y
  std::size_t columns = 0;                          ///< along x
  std::size_t rows = 0;                             ///< along y

  std::size_t
  size() const
  {
    return columns * rows;
  }

  /** \return the index of the cell around a position, row by row from the least y; size() if
   * outside */
  std::size_t
  indexOf(double x, double y) const;

  /** \return [m] the middle of a cell */
  Eigen::Vector2d
  centreOf(std::size_t index) const;
};

/** \brief The extent of scans: their points and their scanners. \ingroup maps */
class MapExtent {
public:
  void
  add(const MappedScan& scan);

  /** \return [m] empty without points */
  const Eigen::AlignedBox3d&
  box() const
  {
    return box_;
  }

  /** \return the least edge of cells [m], a multiple of 1 mm, for a raster of at most
   * most_cells cells */
  double
  leastResolution(std::size_t most_cells) const;

  /** \return cells over the extent; the corner is a multiple of the resolution
   * \throws ComputeFailed the extent is empty: no points
   * \throws BadArgument the resolution is not > 0 and finite, or the raster has more than
   * most_cells */
  MapRaster
  raster(double resolution, std::size_t most_cells) const;

private:
  Eigen::AlignedBox3d box_;
};

} // namespace pcl6d
