// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/line_assembly.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

namespace pcl6d {
namespace {
DrivenScanner
scannerOf(const RangeLines& lines, const LineAssemblyOptions& options)
{
  options.validate();
  const auto samples = static_cast<std::size_t>(options.scanner.beam.count);
  require(lines.samples_per_line == samples,
          "samples of a line",
          lines.samples_per_line,
          "the number of angles of the beam: " + std::to_string(samples));
  require(lines.ranges.size() == samples * lines.angles.size(),
          "ranges",
          lines.ranges.size(),
          "the number of lines times samples: " +
              std::to_string(samples * lines.angles.size()));
  return DrivenScanner(options.scanner, lines.angles, lines.times);
}
} // namespace

void
LineAssemblyOptions::validate() const
{
  scanner.validate();
  require(min_range >= 0, "min_range", min_range, ">= 0");
  require(max_range > min_range, "max_range", max_range, "> min_range");
}

LineAssembly::LineAssembly(const RangeLines& lines, const LineAssemblyOptions& options)
: scanner_(scannerOf(lines, options))
{
  scan_.num_lines = scanner_.numLines();
  scan_.samples_per_line = scanner_.samplesPerLine();
  for (const double range : lines.ranges) {
    const bool is_return = range > 0 && std::isfinite(range) &&
                           range >= options.min_range && range <= options.max_range;
    scan_.samples.push_back(
        {is_return ? range : std::numeric_limits<double>::quiet_NaN(), 0, 0});
  }
}

pcl::PointCloud<pcl::PointXYZ>
LineAssembly::cloud() const
{
  pcl::PointCloud<pcl::PointXYZ> cloud(
      static_cast<std::uint32_t>(scan_.samples_per_line),
      static_cast<std::uint32_t>(scan_.num_lines));
  cloud.is_dense = true;
  auto point = cloud.begin();
  for (int line = 0; line < scan_.num_lines; ++line)
    for (int i = 0; i < scan_.samples_per_line; ++i, ++point) {
      const Ray ray = scanner_.ray(line, i);
      const double range = scan_.at(line, i).range; // NaN makes a point of NaN
      point->getVector3fMap() = (ray.origin + range * ray.direction).cast<float>();
      cloud.is_dense = cloud.is_dense && std::isfinite(range);
    }
  return cloud;
}

} // namespace pcl6d
