// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief [line spacings] Edge of a voxel: on surfaces facing the scanner, up to 1.3 times the
 * median range, no row of voxels lies between two lines. Measured: 1.4 and more lose detail of
 * narrow corridors, below 1 registration of rooms fails (share/doc/sampling.md, Voxel). */
inline constexpr double kVoxelOfLines = 1.3;

/** \brief Arrangement of the points of a scan, seen from the scanner. */
enum class ScanStructure {
  kEven,   ///< equally dense in every direction: grids, merged and unordered points
  kLines,  ///< dense along lines, which lie farther apart than the points of a line
  kRings,  ///< lines at constant elevations, one above the other: spinning lidars
  kOneLine ///< a single line of a 2D scanner, without a second direction
};

/** \return even, lines, rings or one line */
PCL6D_EXPORTS const char*
toString(ScanStructure structure);

/** \brief The sampling of a scan: angles at the scanner between points and between lines. Spacings
 * [m] grow with the range: spacing = angle x range.
 *
 * A spinning lidar with 16 rings measures every 0.2 degrees along a ring, and the next ring is
 * 2 degrees away. A piece of surface for a voxel, a normal or a pair of points must be at least of
 * the size of the line spacing. \ingroup filters */
struct ScanSampling {
  ScanStructure structure = ScanStructure::kEven;
  double point_angle = 0;  ///< [rad] from a point to its nearest neighbour, median
  double line_angle = 0;   ///< [rad] from a point to the nearest point across its line;
                           ///< 0 for a single line or no scan
  double median_range = 0; ///< [m]
  double lowest = 0;       ///< [rad] elevation above the x-y plane, 0.5 % lie below
  double highest = 0;      ///< [rad] 0.5 % lie above
  std::size_t rings = 0;   ///< of kRings

  /** \return the distance [m] between lines on a surface facing the scanner, at the median range */
  double
  lineSpacing() const
  {
    return line_angle * median_range;
  }
  /** \return the derivation of the line spacing, for example "16 rings 2 deg apart, at 2.3 m" */
  std::string
  text() const;
};

/** \brief Measures the sampling from the geometry alone: about 300 directions, evenly chosen; the
 * line through a point is the principal axis of its 5 nearest directions, and directions at more
 * than 45 degrees to the line are across (share/doc/sampling.md, Line spacing and structure).
 * \param[in] points [m] in any order; points that are not finite or at the scanner are left out;
 * copies of a point count once
 * \param[in] origin [m] of the scanner, in the frame of the points */
PCL6D_EXPORTS ScanSampling
samplingOf(const Points& points,
           const Eigen::Vector3f& origin = Eigen::Vector3f::Zero());

} // namespace pcl6d
