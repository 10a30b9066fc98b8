// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/maps/map_raster.h>
#include <pcl6d/maps/mapped_scan.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The heights of the points in each cell of a map: a digital elevation model.
 * \ingroup maps */
class HeightMap {
public:
  /** \brief The points of a cell. */
  struct Cell {
    std::size_t points = 0;
    double sum = 0;    ///< [m] of their heights
    float lowest = 0;  ///< [m] valid for points > 0
    float highest = 0; ///< [m] valid for points > 0
  };

  /** \param[in] raster covers all scans */
  explicit HeightMap(const MapRaster& raster);

  void
  insert(const MappedScan& scan);

  const Cell&
  cell(std::size_t index) const
  {
    return cells_[index];
  }

  const MapRaster&
  raster() const
  {
    return raster_;
  }

private:
  MapRaster raster_;
  std::vector<Cell> cells_;
};

/** \return whether the library was built with GDAL, required by writeGeoTiff() */
bool
canWriteGeoTiff();

/** \brief Writes the lowest, highest and mean height [m] as three bands of float32 of a GeoTIFF,
 * atomically; NaN, declared as NoData, for cells without points. The first row has the largest
 * y. \param[in] offset [m] added to all coordinates, such as the world offset
 * \param[in] coordinate_system in well-known text (wktOfEpsg()), or empty
 * \throws ComputeFailed the library was built without GDAL
 * \throws IoFailed the file cannot be written \ingroup maps */
void
writeGeoTiff(const std::filesystem::path& path,
             const HeightMap& map,
             const Eigen::Vector3d& offset,
             const std::string& coordinate_system = {});

} // namespace pcl6d
