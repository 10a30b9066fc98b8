// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How the points of a scan lie, seen from its scanner. */
enum class ScanStructure {
  kEven,   ///< about as dense in every direction: grids, merged and unordered points
  kLines,  ///< dense along lines that lie farther apart than the points of a line
  kRings,  ///< such lines at constant elevations, one above the other: spinning lidars
  kOneLine ///< a single line, as of a 2D scanner: there is no second direction
};

/** \return even, lines, rings or one line */
PCL6D_EXPORTS const char*
toString(ScanStructure structure);

/** \brief The sampling of a scan: how far its points and its lines lie apart, as angles at
 * the scanner. Spacings [m] grow with the range: spacing = angle x range.
 *
 * A spinning lidar with 16 rings measures every 0.2 degrees along a ring, and the next ring
 * is 2 degrees away. What needs a piece of surface, such as a voxel, a normal or a pair of
 * points, has to be as large as the second of them. \ingroup filters */
struct ScanSampling {
  ScanStructure structure = ScanStructure::kEven;
  double point_angle = 0;  ///< [rad] from a point to the nearest other one, median
  double line_angle = 0;   ///< [rad] from a point to the nearest one across its line; 0
                           ///< where the scan has a single line or is no scan
  double median_range = 0; ///< [m]
  double lowest = 0;       ///< [rad] elevation above the x-y plane, 0.5 % lie below
  double highest = 0;      ///< [rad] 0.5 % lie above
  std::size_t rings = 0;   ///< of kRings

  /** \return the distance [m] between lines on a surface that faces the scanner, at the
   * median range */
  double
  lineSpacing() const
  {
    return line_angle * median_range;
  }
  /** \return what the line spacing follows from, such as "16 rings 2 deg apart, at 2.3 m" */
  std::string
  text() const;
};

/** \brief Measures the sampling from the geometry alone: about 300 directions, evenly chosen;
 * the line through a point is the principal axis of its 5 nearest directions, and what lies
 * at more than 45 degrees to it is across (algorithms.md S.2, rule C).
 * \param[in] points [m] what is not finite or at the scanner does not count. Their order does
 * not matter; copies of a point count once
 * \param[in] origin [m] of the scanner, in the frame of the points */
PCL6D_EXPORTS ScanSampling
samplingOf(const Points& points,
           const Eigen::Vector3f& origin = Eigen::Vector3f::Zero());

} // namespace pcl6d
