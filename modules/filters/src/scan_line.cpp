// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/filters/scan_line.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

void
ScanLineMedianOptions::validate() const
{
  require(window >= 3 && window % 2 == 1, "window", window, "odd and >= 3");
  require(threshold > 0 && std::isfinite(threshold),
          "threshold",
          threshold,
          "finite and > 0");
}

void
ScanLineReductionOptions::validate() const
{
  require(max_distance > 0 && std::isfinite(max_distance),
          "max_distance",
          max_distance,
          "finite and > 0");
  require(line_step >= 1, "line_step", line_step, ">= 1");
}

namespace {
constexpr double kInvalid = std::numeric_limits<double>::quiet_NaN();

/** \return the distances from the scanner; kInvalid without a ray */
std::vector<double>
rayLengths(const Points& points)
{
  std::vector<double> ranges;
  ranges.reserve(points.size());
  for (const auto& p : points) {
    const double range = p.cast<double>().norm();
    ranges.push_back(std::isfinite(range) && range > 0 ? range : kInvalid);
  }
  return ranges;
}

/** \return the median; of an even number, the nearer of the middle two to the value.
 * \param[in,out] values at least one; reordered */
double
medianNear(double value, std::vector<double>& values)
{
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1)
    return *upper;
  const double lower = *std::max_element(values.begin(), upper);
  return std::abs(value - lower) <= std::abs(*upper - value) ? lower : *upper;
}

void
requireLineLength(std::size_t line_length)
{
  require(line_length > 0, "line_length", line_length, "> 0");
}
} // namespace

Points
medianAlongLines(const Points& points,
                 std::size_t line_length,
                 const ScanLineMedianOptions& options)
{
  options.validate();
  requireLineLength(line_length);
  const std::vector<double> ranges = rayLengths(points);
  const auto half = static_cast<std::size_t>(options.window / 2);
  Points filtered = points;
  std::vector<double> window;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isnan(ranges[i]))
      continue;
    const std::size_t line = i - i % line_length; // first place of the line
    const std::size_t line_end =
        line_length < points.size() - line ? line + line_length : points.size();
    const std::size_t end = half < line_end - i ? i + half + 1 : line_end;
    window.clear();
    for (std::size_t k = i - std::min(half, i - line); k < end; ++k)
      if (!std::isnan(ranges[k]))
        window.push_back(ranges[k]);
    const double median = medianNear(ranges[i], window);
    if (std::abs(ranges[i] - median) > options.threshold)
      filtered[i] = (points[i].cast<double>() * (median / ranges[i])).cast<float>();
  }
  return filtered;
}

std::vector<LineGroup>
groupAlongLines(const Points& points,
                std::size_t line_length,
                const ScanLineReductionOptions& options)
{
  options.validate();
  requireLineLength(line_length);
  const double limit_sq = options.max_distance * options.max_distance;
  std::vector<LineGroup> groups;
  std::size_t line_of_group = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t line = i / line_length;
    if (line % static_cast<std::size_t>(options.line_step) != 0 ||
        !points[i].allFinite())
      continue;
    const auto distanceSq = [&](std::size_t k) {
      return (points[i].cast<double>() - points[k].cast<double>()).squaredNorm();
    };
    if (groups.empty() || line != line_of_group ||
        !(distanceSq(groups.back().begin) < limit_sq)) {
      groups.push_back({i, i});
      line_of_group = line;
    }
    groups.back().end = i + 1;
  }
  return groups;
}

Points
reduceAlongLines(const Points& points,
                 std::size_t line_length,
                 const ScanLineReductionOptions& options)
{
  Points reduced;
  for (const LineGroup& group : groupAlongLines(points, line_length, options)) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    for (std::size_t i = group.begin; i < group.end; ++i)
      if (points[i].allFinite()) {
        sum += points[i].cast<double>();
        ++count;
      }
    reduced.push_back((sum / count).cast<float>());
  }
  return reduced;
}

std::size_t
lineLengthOf(std::size_t width, std::size_t height, std::size_t size, int given)
{
  if (size == 0)
    return 1;
  if (height <= 1) {
    require(given > 0,
            "line_length",
            given,
            "given by setLineLength(): the cloud is not organized (height 1)");
    return static_cast<std::size_t>(given);
  }
  require(width * height == size,
          "number of points",
          size,
          "width x height = " + std::to_string(width) + " x " + std::to_string(height));
  require(given == 0 || static_cast<std::size_t>(given) == width,
          "line_length",
          given,
          "the width of the organized cloud, " + std::to_string(width));
  return width;
}

} // namespace pcl6d
