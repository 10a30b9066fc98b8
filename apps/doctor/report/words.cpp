// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/finding.h"
#include "doctor/report/words.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/io/text.h>

#include <cmath>
#include <cstdio>

namespace pcl6d::app {

const char*
toString(Severity severity)
{
  return severity == Severity::kProblem   ? "problem"
         : severity == Severity::kWarning ? "warning"
                                          : "note";
}

std::string
shortNumber(double value, int digits)
{
  char text[48];
  const double size = std::abs(value);
  if (size >= std::pow(10.0, digits) - 0.5 && size < 1e7)
    std::snprintf(text, sizeof text, "%.0f", value); // 2490, not 2.49e+03
  else
    std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string
metres(double value)
{
  return shortNumber(value) + " m";
}

std::string
percentText(double share)
{
  return shortNumber(100 * share, 2) + " %";
}

std::string
shareText(std::size_t part, std::size_t whole)
{
  const double share =
      whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
  return std::to_string(part) + " of " + std::to_string(whole) + " (" +
         percentText(share) + ")";
}

std::string
motionText(double translation, double rotation)
{
  return metres(translation) + ", " + shortNumber(degrees(rotation)) + " deg";
}

std::string
vectorText(const Eigen::Vector3d& v)
{
  return text::shortest(v.x()) + ", " + text::shortest(v.y()) + ", " +
         text::shortest(v.z());
}

std::string
placeText(const Eigen::Vector3d& v)
{
  std::string words;
  for (const double value : v) {
    char text[48];
    const char* const format = std::abs(value) < 10 ? "%.4g" : "%.3f";
    std::snprintf(text, sizeof text, format, value);
    words += (words.empty() ? "" : ", ") + std::string(text);
  }
  return words;
}

} // namespace pcl6d::app
