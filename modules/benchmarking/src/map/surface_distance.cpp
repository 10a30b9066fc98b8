// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/surface_distance.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
/** \return the quantile of the values at a share; reorders the values */
double
quantile(std::vector<float>& values, double share)
{
  const auto place =
      std::min(values.size() - 1,
               static_cast<std::size_t>(share * static_cast<double>(values.size())));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}
} // namespace

DistanceStatistics
distanceStatistics(std::vector<float> distances, double within)
{
  DistanceStatistics statistics;
  statistics.count = distances.size();
  if (distances.empty()) {
    statistics.rms = statistics.mean = statistics.median = statistics.percentile_95 =
        statistics.share_within = std::numeric_limits<double>::quiet_NaN();
    return statistics;
  }
  double sum = 0, sum_sq = 0;
  std::size_t near = 0;
  for (const float distance : distances) {
    require(std::isfinite(distance) && distance >= 0,
            "distance",
            distance,
            "finite and >= 0");
    const double d = distance;
    sum += d;
    sum_sq += d * d;
    near += d <= within;
  }
  const auto count = static_cast<double>(distances.size());
  statistics.rms = std::sqrt(sum_sq / count);
  statistics.mean = sum / count;
  statistics.median = quantile(distances, 0.5);
  statistics.percentile_95 = quantile(distances, 0.95);
  statistics.share_within = static_cast<double>(near) / count;
  return statistics;
}

} // namespace pcl6d
