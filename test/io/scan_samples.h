// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io_test.h"

#include <pcl6d/common/random.h>
#include <pcl6d/io/scan_writer.h>

#include <array>
#include <cmath>
#include <limits>

namespace pcl6d::test {

/** \brief A way to write a scan. */
struct Way {
  std::string name;
  ScanFormat format;
  PcdEncoding encoding = PcdEncoding::kBinary;
  bool has_intensity = true;
};
inline const std::vector<Way> kWays = {
    {"PCD text", ScanFormat::kPcd, PcdEncoding::kAscii},
    {"PCD binary", ScanFormat::kPcd, PcdEncoding::kBinary},
    {"PCD compressed", ScanFormat::kPcd, PcdEncoding::kBinaryCompressed},
    {"PLY text", ScanFormat::kPly, PcdEncoding::kAscii},
    {"PLY binary", ScanFormat::kPly, PcdEncoding::kBinary},
    {"KITTI", ScanFormat::kKitti},
    {"uosr", ScanFormat::kUosr},
    {"uos", ScanFormat::kUos, PcdEncoding::kBinary, false},
    {"xyz", ScanFormat::kXyz, PcdEncoding::kBinary, false},
};

/** \return points x y z intensity */
inline pcl::PCLPointCloud2
floatCloud(const std::vector<std::array<float, 4>>& points)
{
  pcl::PCLPointCloud2 cloud;
  for (const char* const name : {"x", "y", "z", "intensity"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += 4;
  }
  cloud.width = static_cast<pcl::uindex_t>(points.size());
  cloud.height = 1;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  if (!points.empty())
    std::memcpy(cloud.data.data(), points.data(), cloud.data.size());
  return cloud;
}

/** \return any finite float, from the smallest to the largest */
inline float
anyFloat(Random& random)
{
  for (;;) {
    const auto bits = static_cast<std::uint32_t>(random.uniform() * 0x1p32);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value))
      return value;
  }
}

/** \return random points with intensity, every seventh not finite if wanted */
inline pcl::PCLPointCloud2
randomCloud(std::size_t count, bool with_nan)
{
  Random random(count + 1);
  std::vector<std::array<float, 4>> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (float& value : points[i]) // half of any size, half of usual size
      value = i % 2 ? anyFloat(random) : static_cast<float>(random.uniform(-100, 100));
    if (with_nan && i % 7 == 3)
      points[i][i % 3] = i % 2 ? std::numeric_limits<float>::quiet_NaN()
                               : std::numeric_limits<float>::infinity();
  }
  return floatCloud(points);
}

} // namespace pcl6d::test
