// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

/** \file Numbers in the words of rejections. */
namespace pcl6d::rejection_numbers {

/** \return three digits, without powers of ten */
inline std::string
shortNumber(double value)
{
  constexpr double kWholeFrom = 100;
  std::ostringstream digits;
  if (std::abs(value) >= kWholeFrom)
    digits << std::fixed;
  digits.precision(std::abs(value) >= kWholeFrom ? 0 : 3);
  digits << value;
  return digits.str();
}

/** \return two digits */
inline std::string
percent(double share)
{
  std::ostringstream digits;
  digits.precision(2);
  digits << 100 * share;
  return digits.str();
}

/** \param[in] decimals digits behind the point */
inline std::string
fixed(double value, int decimals)
{
  std::ostringstream digits;
  digits << std::fixed << std::setprecision(decimals) << value;
  return digits.str();
}

/** \return " and 3 more"; empty for none */
inline std::string
andMore(double number)
{
  return number > 0 ? " and " + shortNumber(number) + " more" : "";
}

/** \return "1 scan", "2 scans" */
inline std::string
countOf(double number, const std::string& noun)
{
  return shortNumber(number) + ' ' + noun + (number == 1 ? "" : "s");
}

} // namespace pcl6d::rejection_numbers
