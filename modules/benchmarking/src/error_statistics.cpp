// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/common/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl6d {

namespace {
double
medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1)
    return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}
} // namespace

ErrorStatistics
errorStatistics(const std::vector<double>& errors)
{
  ErrorStatistics statistics;
  if (errors.empty())
    return statistics;
  double sum = 0, sum_sq = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!std::isfinite(errors[i]) || errors[i] < 0)
      throw BadArgument("error " + std::to_string(i) + " = " +
                        std::to_string(errors[i]) + ", but must be finite and >= 0");
    sum += errors[i];
    sum_sq += errors[i] * errors[i];
  }
  const auto count = static_cast<double>(errors.size());
  const auto largest = std::max_element(errors.begin(), errors.end());
  statistics.count = errors.size();
  statistics.rms = std::sqrt(sum_sq / count);
  statistics.mean = sum / count;
  statistics.median = medianOf(errors);
  statistics.max = *largest;
  statistics.index_of_max = static_cast<std::size_t>(largest - errors.begin());
  return statistics;
}

} // namespace pcl6d
