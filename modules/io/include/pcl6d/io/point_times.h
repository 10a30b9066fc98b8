// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <pcl/PCLPointCloud2.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Rule for the times of points in files without times. kAzimuth: the scanner turns
 * clockwise seen from above, and the stamp is the time of facing forward (KITTI raw,
 * KITTI-360). kColumns: 64 points a column, 1024 columns a turn, stamped at the first column
 * (MulRan). */
enum class PointTimeRule { kNone, kAzimuth, kColumns };

/** \brief A rule with its duration. */
struct PointTimes {
  PointTimeRule rule = PointTimeRule::kNone;
  double period = 0; ///< [s] of a turn of the scanner; 0: not known, no times are added
};

/** \brief Adds the field `time` (float32, seconds since the stamp of the scan), unless already
 * present.
 *
 * kAzimuth: -atan2(y, x) / (2 pi) periods. kColumns: floor(i / 64) / 1024 periods for the i-th
 * point; 0 for a cloud without exactly 64 x 1024 points, since its columns are not known.
 * \param[in,out] cloud all points of the file, in file order, with x and y
 * \note Source: A. Geiger, P. Lenz, C. Stiller, R. Urtasun, "Vision meets robotics: the KITTI
 * dataset", IJRR 32(11), 2013: the stamp is the time of facing forward. \ingroup io */
void
addPointTimes(const PointTimes& times, pcl::PCLPointCloud2& cloud);

} // namespace pcl6d
