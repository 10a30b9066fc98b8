// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Whether a scan comes from a 2D scanner that turns in its x-y plane.
 *
 * Such a scan has points of equal height (within a thousandth of the median range), directions that
 * fill more than a quarter of a turn, and similar ranges in neighbouring directions: a line around
 * the scanner. The points of a floor seen from above also have equal height, but fill an area:
 * neighbours in direction have different ranges.
 * \param[in] points [m] in the frame of the scanner; points that are not finite are skipped
 * \return false for fewer than 12 points
 * \note The scans of a profile scanner carried along its axis are planar, too. The poses then leave
 * the plane (isInPlane()); without poses the scanner is taken for a 2D scanner. \ingroup filters */
bool
isPlanarScan(const Points& points);

/** \brief Turns a planar scan into upright walls: copies of its points above and below, and a
 * horizontal ledge at the top and at the bottom of each wall, towards the scanner.
 *
 * A planar scan measures x, y and yaw. If the scanner stays in one plane and every surface is
 * upright (the usual assumption of 2D maps), the walls also determine roll and pitch, and the
 * ledges determine the height: methods for 3D scans work on planar scans. The vertical normals of
 * the ledges do not constrain x, y and yaw.
 * \param[in] points [m] a planar scan \param[in] row_spacing [m] between the copies, > 0
 * \return each finite point, 6 copies above and 6 below, and up to 5 points of each ledge (not
 * nearer to the scanner than one row spacing)
 * \throws BadArgument row_spacing is not finite and > 0 */
Points
raisedPlanarScan(const Points& points, double row_spacing);

/** \brief Moves a pose into the x-y plane of another pose.
 * \param[in] T_world_plane, T_world_scan rigid poses
 * \return T_world_scan with unchanged x, y and yaw, and zero height, roll and pitch, in the
 * frame of the plane. A pose in the plane to 1e-9 is returned unchanged; an upside-down pose has
 * no yaw and gets zero */
Eigen::Isometry3d
poseInPlane(const Eigen::Isometry3d& T_world_plane,
            const Eigen::Isometry3d& T_world_scan);

/** \return whether a pose lies in the x-y plane of another pose: tilted by at most 5 degrees, and
 * no higher or lower than a slope of 5 degrees over their distance, or 5 cm */
bool
isInPlane(const Eigen::Isometry3d& T_world_plane,
          const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
