// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of virtualScan(). */
struct VirtualScanOptions {
  double column = 0.026;        ///< [rad] width of a column; in (0, pi]
  double max_slope = 0.31;      ///< [rad] of the ground; in (0, pi / 2)
  double max_ground_step = 0.3; ///< [m] of the ground from point to point; > 0
  double max_gap = 0.3;         ///< [m] between the ranges in one group; > 0
  double min_height = 1.2;      ///< [m] vertical extent of a wall; > 0
  std::size_t min_points = 5;   ///< on a wall in one column; > 0
  double max_spread = 0.2;      ///< [m] of the ranges of a wall facing the scanner; > 0
  double max_thickness = 0.1;   ///< [m] rms of a wall about its line; > 0
  std::size_t max_columns = 100; ///< most walls kept, chosen at random; > 0
  std::uint64_t seed = 1;        ///< of the choice
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The walls around a scanner, in the form of a 2D scan. */
struct VirtualScan {
  std::vector<Eigen::Vector2d> points; ///< [m] in the levelled frame of the scan
  std::size_t walls = 0;               ///< columns with a wall, before the choice
  double ground = 0; ///< [m] height of the ground at the scanner in the levelled frame,
                     ///< < 0 below the scanner; NaN without points near by
};

/** \brief Makes a 2D scan from a 3D scan (book 6.4.2).
 *
 * The cloud is cut into vertical columns by azimuth, whatever the scanner. In each column the
 * ground is followed outwards and left out; the remaining points are grouped by horizontal range. A
 * high and thin group of enough points is a wall. Thin means: at one range, or along a line in the
 * plan, thin against the width of the column, like a wall seen at an angle; leaves fill the column.
 * The farthest wall of each column counts, since scanners see walls above parked cars and people.
 * Points are the centres of the groups.
 * \param[in] points [m] in the scan's frame; points that are not finite are skipped
 * \param[in] R_level_scan turns the points upright (roll and pitch); see levelByWalls()
 * \throws BadArgument an option is invalid
 * \note Source: O. Wulf, A. Nuechter, J. Hertzberg, B. Wagner, "Benchmarking urban
 * six-degree-of-freedom simultaneous localization and mapping", Journal of Field Robotics
 * 25(3), 2008. \ingroup localisation */
VirtualScan
virtualScan(const Points& points,
            const Eigen::Matrix3d& R_level_scan = Eigen::Matrix3d::Identity(),
            const VirtualScanOptions& options = VirtualScanOptions());

/** \brief The points of a scan without the ground, found like in virtualScan().
 * \return points in the scan's frame, in the order of their columns */
Points
withoutGround(const Points& points,
              const Eigen::Matrix3d& R_level_scan,
              const VirtualScanOptions& options = VirtualScanOptions());

} // namespace pcl6d
