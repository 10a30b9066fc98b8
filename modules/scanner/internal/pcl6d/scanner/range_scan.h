// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/range_error_model.h>
#include <pcl6d/scanner/scanner_model.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The samples of a scan in double, line by line. */
struct RangeScan {
  int num_lines = 0;
  int samples_per_line = 0;
  std::vector<RangeSample> samples; ///< line * samples_per_line + sample

  const RangeSample&
  at(int line, int sample) const
  {
    return samples[static_cast<std::size_t>(line) *
                       static_cast<std::size_t>(samples_per_line) +
                   static_cast<std::size_t>(sample)];
  }
};

/** \return organized cloud in the scanner's frame, one row per line; a sample without
 * return is NaN, never zero. \throws BadArgument scan and scanner differ in size */
pcl::PointCloud<pcl::PointXYZI>
toPointCloud(const RangeScan& scan, const ScannerModel& scanner);

/** \brief Appends the field `t` (float32, [s]): measuring time of each point, from the
 * start of the scan. \param[in] cloud one row per line, from toPointCloud()
 * \throws BadArgument cloud and scanner differ in size */
void
addTimeField(pcl::PCLPointCloud2& cloud, const ScannerModel& scanner);

} // namespace pcl6d
