// SPDX-License-Identifier: BSD-3-Clause
#include "scan_size.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_scan.h>

#include <cstdio>

namespace pcl6d {

void
requireScanSize(double num_lines, double samples_per_line)
{
  constexpr double kMostSamples = 1e8;
  constexpr double kBytes = sizeof(RangeSample) + sizeof(pcl::PointXYZI);
  require(num_lines >= 1, "lines of a scan", num_lines, ">= 1");
  require(samples_per_line >= 1, "samples of a line", samples_per_line, ">= 1");
  const double samples = num_lines * samples_per_line;
  if (samples <= kMostSamples)
    return;
  char message[160];
  std::snprintf(message,
                sizeof message,
                "a scan of %.9g lines of %.9g samples takes %.3g GB, but must be of at "
                "most %g samples (%.3g GB)",
                num_lines,
                samples_per_line,
                samples * kBytes * 1e-9,
                kMostSamples,
                kMostSamples * kBytes * 1e-9);
  throw BadArgument(message);
}

} // namespace pcl6d
