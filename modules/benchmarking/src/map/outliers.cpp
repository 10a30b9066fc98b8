// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/outliers.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

std::vector<double>
robustScores(const std::vector<double>& values, double least_spread)
{
  require(least_spread > 0, "least_spread", least_spread, "> 0");
  constexpr double kSigmaPerMad = 1.4826; // of a normal distribution
  std::vector<double> measured;
  for (const double value : values)
    if (!std::isnan(value))
      measured.push_back(value);
  const double median = upperMedian(measured);
  for (double& value : measured)
    value = std::abs(value - median);
  const double spread = std::max(least_spread, kSigmaPerMad * upperMedian(measured));
  std::vector<double> scores;
  for (const double value : values)
    scores.push_back((value - median) / spread); // NaN stays NaN
  return scores;
}

} // namespace pcl6d
