// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace pcl6d::app {

/** \brief Guesses a wrong unit of length. Scans of one site have similar ranges: median
 * 2 m hand-held indoors, 40 m from a tripod outdoors. A wrong unit scales the ranges by
 * 100 or 1000.
 * \param[in] far, near names of the scans \param[in] range_far, range_near [m] typical
 * ranges
 * \return the likely mistake, in words; empty if the ratio of the ranges fits no unit */
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
