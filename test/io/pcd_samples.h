// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io_test.h"

#include <pcl6d/io/pcd_io.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace pcl6d::test {

inline const PcdEncoding kEncodings[] = {PcdEncoding::kAscii,
                                         PcdEncoding::kBinary,
                                         PcdEncoding::kBinaryCompressed};

/** \return fields of all kinds with gaps between them, 56 bytes */
inline std::vector<pcl::PCLPointField>
richFields()
{
  using Field = pcl::PCLPointField;
  struct Kind {
    const char* name;
    std::uint32_t offset;
    std::uint8_t datatype;
    std::uint32_t count;
  };
  std::vector<Field> fields;
  for (const Kind& kind : {Kind{"x", 0, Field::FLOAT32, 1},
                           Kind{"y", 4, Field::FLOAT32, 1},
                           Kind{"z", 8, Field::FLOAT32, 1},
                           Kind{"rgb", 16, Field::FLOAT32, 1},
                           Kind{"intensity", 20, Field::FLOAT32, 1},
                           Kind{"label", 24, Field::UINT32, 1},
                           Kind{"moments", 28, Field::FLOAT32, 3},
                           Kind{"time", 40, Field::FLOAT64, 1},
                           Kind{"ring", 48, Field::UINT8, 1},
                           Kind{"tilt", 50, Field::INT16, 1}}) {
    Field field;
    field.name = kind.name;
    field.offset = kind.offset;
    field.datatype = kind.datatype;
    field.count = kind.count;
    fields.push_back(field);
  }
  return fields;
}

/** \brief Writes the i-th point, with the fields of richFields(). */
inline void
writeRichPoint(std::uint8_t* point, std::size_t i)
{
  const auto put = [point](std::size_t offset, auto value) {
    std::memcpy(point + offset, &value, sizeof value);
  };
  const auto k = static_cast<float>(i);
  put(0, 0.1f * k);
  put(4, -1e-30f * k);
  put(8, i == 1 ? std::numeric_limits<float>::quiet_NaN() : std::sqrt(k));
  put(16, std::uint32_t{0xff902030} + static_cast<std::uint32_t>(i)); // nan as float
  put(20, 1.0f / (k + 1));
  put(24, std::uint32_t{4000000000} + static_cast<std::uint32_t>(i));
  for (std::size_t m = 0; m < 3; ++m)
    put(28 + 4 * m, k + 0.25f * static_cast<float>(m));
  put(40, 1317384506.40528 + 0.1 * static_cast<double>(i));
  put(48, static_cast<std::uint8_t>(200 + i % 50));
  put(50, static_cast<std::int16_t>(-300 - static_cast<int>(i)));
}

/** \return `count` points with fields of all kinds and gaps between them: x y z, packed
 * colour, intensity, uint32 label, three values per point, a double, small integers */
inline pcl::PCLPointCloud2
makeRichCloud(std::size_t count)
{
  pcl::PCLPointCloud2 cloud;
  cloud.fields = richFields();
  cloud.width = static_cast<pcl::uindex_t>(count);
  cloud.height = 1;
  cloud.point_step = 56;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  for (std::size_t i = 0; i < count; ++i)
    writeRichPoint(&cloud.data[i * cloud.point_step], i);
  return cloud;
}

/** Expects the same names and the same bits in every field. */
inline void
expectSameFields(const pcl::PCLPointCloud2& a, const pcl::PCLPointCloud2& b)
{
  ASSERT_EQ(a.fields.size(), b.fields.size());
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  for (std::size_t f = 0; f < a.fields.size(); ++f) {
    const auto& field = a.fields[f];
    EXPECT_EQ(field.name, b.fields[f].name);
    EXPECT_EQ(field.count, b.fields[f].count);
    std::size_t size = field.datatype == pcl::PCLPointField::FLOAT64 ? 8
                       : field.datatype == pcl::PCLPointField::INT16 ? 2
                       : field.datatype == pcl::PCLPointField::UINT8 ? 1
                                                                     : 4;
    size *= field.count;
    for (std::size_t i = 0; i < std::size_t{a.width} * a.height; ++i)
      ASSERT_EQ(std::memcmp(&a.data[i * a.point_step + field.offset],
                            &b.data[i * b.point_step + b.fields[f].offset],
                            size),
                0)
          << "field " << field.name << " of point " << i;
  }
}

} // namespace pcl6d::test
