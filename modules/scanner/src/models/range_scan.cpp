// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/scanner/range_scan.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

namespace pcl6d {

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
      // The range of a missing return is NaN, which makes its coordinates NaN.
      point->getVector3fMap() =
          (ray.origin + sample.range * ray.direction).cast<float>();
      point->intensity = static_cast<float>(sample.intensity);
      cloud.is_dense = cloud.is_dense && std::isfinite(sample.range);
    }
  return cloud;
}

void
addTimeField(pcl::PCLPointCloud2& cloud, const ScannerModel& scanner)
{
  std::vector<double> times;
  for (int line = 0; line < scanner.numLines(); ++line)
    for (int sample = 0; sample < scanner.samplesPerLine(); ++sample)
      times.push_back(scanner.time(line, sample));
  addField(cloud, "t", pcl::PCLPointField::FLOAT32, times);
}

} // namespace pcl6d
