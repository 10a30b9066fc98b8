// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace pcl6d::app {

/** \brief Scans of one site reach about equally far: hand-held ones indoors 2 m in the median,
 * those from a tripod outdoors 40 m. Of other units one is 100 or 1000 times as large.
 * \param[in] far, near names of the scans \param[in] range_far, range_near [m] typical ranges
 * \return what is likely wrong, in words; empty if the larger range is no such multiple */
inline std::string
unitGuess(const std::string& far,
          double range_far,
          const std::string& near,
          double range_near)
{
  constexpr double kOtherUnit = 50, kMillimetres = 316; // the root of 100 * 1000
  if (range_near > range_far)
    return unitGuess(near, range_near, far, range_far);
  if (!(range_near > 0) || range_far < kOtherUnit * range_near)
    return "";
  const double times = range_far / range_near;
  char numbers[160];
  std::snprintf(numbers,
                sizeof numbers,
                "%.3g m in the median, %.3g times as far as ",
                range_far,
                times);
  return far + ": its scans reach " + numbers + near + ": as if they were in " +
         (times < kMillimetres ? "centimetres" : "millimetres") + ", not in metres";
}

} // namespace pcl6d::app
