// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/range_lines.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/range_scan.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Mounting of the 2D scanner on its drive, and range limits. */
struct LineAssemblyOptions {
  /// theta is ignored: the angles are measured; beam.count is the number of samples per line
  DrivenScannerOptions scanner;
  double min_range = 0; ///< [m] shorter ranges are no return; >= 0
  double max_range = std::numeric_limits<double>::infinity(); ///< [m] > min_range
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A 3D scan from raw 2D lines and the drive's angles (book 2.2.3), one row per
 * line in measuring order.
 * \code
 * pcl6d::LineAssemblyOptions options;
 * options.scanner.drive = pcl6d::Drive::kPitching;
 * options.scanner.beam = {-M_PI / 2, M_PI / 2, 181};
 * const pcl6d::LineAssembly assembly(pcl6d::readRangeLines("lines.csv"), options);
 * pcl::io::savePCDFile("scan.pcd", assembly.cloud());
 * \endcode \ingroup scanner */
class LineAssembly {
public:
  /** \throws BadArgument an option is invalid, samples per line and angles of the beam
   * differ in number, or not one angle (and time) per line */
  LineAssembly(const RangeLines& lines, const LineAssemblyOptions& options);

  const DrivenScanner&
  scanner() const
  {
    return scanner_;
  }

  const RangeScan&
  scan() const
  {
    return scan_;
  }

  /** \return organized cloud in the scanner's frame [m], computed in double; NaN
   * without return */
  pcl::PointCloud<pcl::PointXYZ>
  cloud() const;

private:
  DrivenScanner scanner_;
  RangeScan scan_;
};

} // namespace pcl6d
