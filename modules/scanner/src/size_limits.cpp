// SPDX-License-Identifier: BSD-3-Clause
#include "size_limits.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_image.h>
#include <pcl6d/scanner/range_scan.h>

#include <pcl/point_types.h>

#include <cstdio>

namespace pcl6d::scanner {

void
requireImageSize(int rows, int cols)
{
  constexpr double kMostPixels = 1e8;
  require(rows >= 1, "rows", rows, ">= 1");
  require(cols >= 1, "cols", cols, ">= 1");
  const double pixels = static_cast<double>(rows) * cols;
  if (pixels <= kMostPixels)
    return;
  constexpr double kGigabyte = 1e9;
  const auto gigabytes = [](double count) {
    return count * RangeImage::kBytesPerPixel / kGigabyte;
  };
  char text[200];
  std::snprintf(text,
                sizeof text,
                "rows x cols = %d x %d (%.3g pixels, %.3g GB), but must be at most %g "
                "pixels (%.3g GB)",
                rows,
                cols,
                pixels,
                gigabytes(pixels),
                kMostPixels,
                gigabytes(kMostPixels));
  throw BadArgument(text);
}

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

} // namespace pcl6d::scanner
