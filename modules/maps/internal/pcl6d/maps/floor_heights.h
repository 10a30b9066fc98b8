// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/maps/map_raster.h>
#include <pcl6d/maps/mapped_scan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The points of scans in layers of 10 cm over cells of half a metre, and the positions
 * of the scanners: the input of FloorHeights. */
class FloorLayers {
public:
  static constexpr double kCell = 0.5;  ///< [m]
  static constexpr double kLayer = 0.1; ///< [m]

  /** \brief Points between two multiples of kLayer. */
  struct Layer {
    std::int32_t number = 0; ///< of the multiple below
    std::uint32_t points = 0;
    double sum = 0; ///< [m] of their heights

    double
    height() const
    {
      return sum / points;
    }
  };

  void
  add(const MappedScan& scan);

  /** \return the layers of the cell at a position, from low to high */
  const std::vector<Layer>&
  at(double x, double y) const;

  /** \return [m] the positions of the scanners */
  const Points&
  scanners() const
  {
    return scanners_;
  }

  /** \return [m] the floor below a scanner: the layer that is lowest in most cells within 3 m,
   * among layers with at least a fifth of the points of the densest layer; empty if fewer than
   * three cells have points below the scanner */
  std::optional<double>
  floorBelow(const Eigen::Vector3f& scanner) const;

private:
  std::unordered_map<std::uint64_t, std::vector<Layer>> cells_;
  Points scanners_;
};

/** \brief The height of the floor everywhere in a map: the surface that can be reached from below
 * the scanners.
 *
 * The floor grows from cell to cell. In the next cell, the floor is the layer of points nearest
 * in height, if at most 5 cm and a slope of 0.3 away (Vosselman, "Slope based filtering of
 * laser altimetry data", 2000). Without such a layer, for example in a wall or behind, the
 * height stays until the floor is found again. Points mirrored in the floor, tables and roofs
 * are not reached. One height per cell: among several storeys, the floor of the nearest
 * scanner. \ingroup maps */
class FloorHeights {
public:
  /** \brief [byte] of a cell in memory while the floor grows. */
  static constexpr std::size_t kBytesOfCell = 48;

  /** \brief A level floor. */
  explicit FloorHeights(double height);

  /** \brief Lets the floor grow over an extent. If no scanner has a floor below, the floor is
   * level with the lowest scanner, and isKnown() is false.
   * \param[in] most_cells limit by the available memory
   * \throws ComputeFailed the map has no points, or needs more cells */
  FloorHeights(const FloorLayers& layers,
               const MapExtent& extent,
               std::size_t most_cells = std::size_t{1} << 32U);

  /** \return [m] the floor at a position, interpolated between cell centres */
  double
  at(double x, double y) const;

  bool
  isKnown() const
  {
    return is_known_;
  }
  double
  lowest() const
  {
    return lowest_;
  }
  double
  highest() const
  {
    return highest_;
  }

private:
  MapRaster raster_; ///< without cells: the floor is level
  std::vector<float> heights_;
  bool is_known_ = true;
  double lowest_ = 0, highest_ = 0;
};

/** \return [m] the median height of positions above the floor, for example of the scanners; 0
 * without positions \ingroup maps */
double
medianHeight(const Points& places, const FloorHeights& floor);

} // namespace pcl6d
