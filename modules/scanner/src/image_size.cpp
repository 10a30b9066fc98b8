// SPDX-License-Identifier: BSD-3-Clause
#include "image_size.h"

#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_image.h>

#include <cstdio>

namespace pcl6d {

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

} // namespace pcl6d
