// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/range_scan.h>

#include <cmath>
#include <limits>

namespace pcl6d {

RangeScan
castScan(const SceneView& view,
         const ScannerModel& scanner,
         const RangeOptions& options,
         std::uint64_t scan_index)
{
  options.validate();
  RangeScan scan{scanner.numLines(), scanner.samplesPerLine(), {}};
  const auto num_lines = static_cast<std::size_t>(scan.num_lines);
  const auto per_line = static_cast<std::size_t>(scan.samples_per_line);
  scan.samples.resize(num_lines * per_line);
  const std::uint64_t scan_key = mixBits(mixBits(options.seed) ^ scan_index);
  parallelFor(num_lines, options.num_threads, [&](std::size_t line) {
    Random random(mixBits(scan_key ^ line)); // its own numbers, whoever does the line
    for (std::size_t i = 0; i < per_line; ++i) {
      RangeSample& sample = scan.samples[line * per_line + i];
      // Drawn with or without return, so that noise does not depend on the scene.
      const double error = options.noise * random.normal();
      const auto row = static_cast<int>(line);
      const auto column = static_cast<int>(i);
      const auto hit = view.cast(scanner.ray(row, column), scanner.time(row, column));
      const double range = hit ? hit->range + error : options.max_range + 1;
      sample.range = std::numeric_limits<double>::quiet_NaN();
      if (!(range >= options.min_range && range <= options.max_range))
        continue;
      sample = {range,
                view.surface(hit->triangle).reflectance * hit->cos_incidence,
                hit->triangle};
    }
  });
  return scan;
}

RangeScan
castScan(const RayCaster& caster,
         const ScannerModel& scanner,
         const Eigen::Isometry3d& T_scene_scan,
         const RangeOptions& options,
         std::uint64_t scan_index)
{
  return castScan(StandingView(caster, T_scene_scan), scanner, options, scan_index);
}

pcl::PointCloud<pcl::PointXYZI>
toPointCloud(const RangeScan& scan, const ScannerModel& scanner)
{
  require(scan.num_lines == scanner.numLines() &&
              scan.samples_per_line == scanner.samplesPerLine(),
          "lines of the scan",
          scan.num_lines,
          "the scanner's");
  pcl::PointCloud<pcl::PointXYZI> cloud(
      static_cast<std::uint32_t>(scan.samples_per_line),
      static_cast<std::uint32_t>(scan.num_lines));
  cloud.is_dense = true;
  auto point = cloud.begin();
  for (int line = 0; line < scan.num_lines; ++line)
    for (int i = 0; i < scan.samples_per_line; ++i, ++point) {
      const RangeSample& sample = scan.at(line, i);
      const Ray ray = scanner.ray(line, i);
      // The range of a missing return is NaN, and so are its coordinates.
      point->getVector3fMap() =
          (ray.origin + sample.range * ray.direction).cast<float>();
      point->intensity = static_cast<float>(sample.intensity);
      cloud.is_dense = cloud.is_dense && std::isfinite(sample.range);
    }
  return cloud;
}

} // namespace pcl6d
