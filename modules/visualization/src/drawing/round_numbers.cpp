// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/round_numbers.h"

#include <cmath>

namespace pcl6d::visualization {

double
roundDown(double metres)
{
  const double power = std::pow(10.0, std::floor(std::log10(metres)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= metres)
      return digit * power;
  return power;
}

std::vector<double>
roundTicks(double low, double high)
{
  constexpr double kMost = 5;
  const double least = (high - low) / kMost;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= least)
      step = digit * power;
  std::vector<double> ticks;
  for (double i = std::ceil(low / step); i * step <= high; ++i)
    ticks.push_back(i * step);
  return ticks;
}

} // namespace pcl6d::visualization
