// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/maps/floor_heights.h>
#include <pcl6d/maps/map_raster.h>
#include <pcl6d/maps/mapped_scan.h>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of GridMap. */
struct GridMapOptions {
  /** [m] above the floor; finite. The default is the highest step that FloorHeights still count
   * as floor: half a layer, and the largest slope over a cell */
  double from = 0.2;
  double to =
      2.0; ///< [m] above the floor; finite, > from; the height of obstacles in nav2
  double max_range = std::numeric_limits<
      double>::infinity(); ///< [m] rays end here, without a hit; > 0

  /** \throws BadArgument naming the first invalid field, with the value */
  void
  validate() const;
};

/** \brief A grid map of obstacles for planners, in the format of ROS map_server.
 *
 * Only heights between `from` and `to` above the floor count. A cell is occupied if a point
 * lies in the cell at these heights, else free if a ray passes through the cell at these
 * heights, else unknown. A single point is enough: many more rays pass above a low obstacle
 * than hit the obstacle. Dynamic points must have been left out before. \ingroup maps */
class GridMap {
public:
  /** \brief [byte] of a cell in memory. */
  static constexpr std::size_t kBytesOfCell = sizeof(float) + sizeof(CellState);

  /** \param[in] raster covers all scans \throws BadArgument an option is invalid */
  GridMap(const MapRaster& raster,
          const FloorHeights& floor,
          const GridMapOptions& options = {});

  void
  insert(const MappedScan& scan);

  /** \param[in] index of a cell of the raster */
  CellState
  state(std::size_t index) const
  {
    return states_[index];
  }

  /** \return the number of cells in a state */
  std::size_t
  count(CellState state) const;

  const MapRaster&
  raster() const
  {
    return raster_;
  }

  /** \brief Writes the image (.pgm, beside the path, of the same name) and then its description
   * (.yaml), each atomically: occupied 0, free 254, unknown 205; the first row of the image has
   * the largest y.
   * \throws BadArgument the extension is not .yaml \throws IoFailed a file cannot be written */
  void
  write(const std::filesystem::path& path) const;

  /** \return the path of the image for a description */
  static std::filesystem::path
  imageOf(const std::filesystem::path& path);

private:
  void
  castRay(const Eigen::Vector3d& begin, const Eigen::Vector3d& end);

  MapRaster raster_;
  GridMapOptions options_;
  double lowest_, highest_;   ///< [m] range of heights that can count in any cell
  std::vector<float> floors_; ///< [m] of each cell
  std::vector<CellState> states_;
};

} // namespace pcl6d
