// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

#include <pcl6d/common/random.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace pcl6d::test {

inline Outcome
convert(const std::vector<std::string>& arguments)
{
  return runProgram("pcl_slam6d_convert", arguments);
}

/** Runs the program and expects success. \return its stdout */
inline std::string
converted(const std::vector<std::string>& arguments)
{
  const Outcome outcome = convert(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.out;
}

/** The same of scans of which one has no points, which is said. */
inline std::string
convertedWithEmptyScan(const std::vector<std::string>& arguments)
{
  const Outcome outcome = convert(arguments);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find(" has no points\n"), std::string::npos) << outcome.err;
  return outcome.out;
}

inline void
expectConvertError(const std::vector<std::string>& arguments,
                   int code,
                   const std::vector<std::string>& words)
{
  expectError(convert(arguments), "pcl_slam6d_convert", code, words);
}

/** \brief A cloud of float32 fields. \param[in] values point by point */
inline pcl::PCLPointCloud2
cloudOf(const std::vector<std::string>& names, const std::vector<float>& values)
{
  pcl::PCLPointCloud2 cloud;
  for (const auto& name : names) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += sizeof(float);
  }
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(values.size() / names.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(values.size() * sizeof(float));
  if (!values.empty())
    std::memcpy(cloud.data.data(), values.data(), cloud.data.size());
  return cloud;
}

/** \return random points with intensity, some of them not finite */
inline pcl::PCLPointCloud2
randomScan(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<float> values;
  for (std::size_t i = 0; i < 4 * count; ++i)
    values.push_back(static_cast<float>(random.uniform(-50, 50)));
  for (std::size_t i = 0; i < count; i += 10)
    values[4 * i + i % 3] = std::numeric_limits<float>::quiet_NaN();
  return cloudOf({"x", "y", "z", "intensity"}, values);
}

/** \return the value of a float32 field */
inline float
floatOf(const pcl::PCLPointCloud2& cloud, std::size_t point, const std::string& name)
{
  float value = 0;
  for (const auto& field : cloud.fields)
    if (field.name == name) {
      std::memcpy(&value,
                  &cloud.data.at(point * cloud.point_step + field.offset),
                  sizeof value);
      return value;
    }
  ADD_FAILURE() << "no field " << name;
  return value;
}

} // namespace pcl6d::test
