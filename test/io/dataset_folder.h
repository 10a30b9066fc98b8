// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io_test.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>

#include <string>
#include <vector>

/** \file Folders laid out like published data sets, with made scans of known points. */
namespace pcl6d::test {

inline std::string
floats(const std::vector<float>& values)
{
  return bytesOf(values);
}

/** Four points of KITTI: ahead, left, right, and behind. */
inline std::string
kittiScan()
{
  return floats({5, 0, 1, 0.5f, 0, 4, 1, 0.25f, 0, -4, 1, 0.75f, -3, -3, 1, 1});
}

inline void
writeFile(const std::filesystem::path& path, const std::string& content)
{
  std::filesystem::create_directories(path.parent_path());
  writeText(path, content);
}

inline std::vector<double>
valuesOf(const pcl::PCLPointCloud2& cloud, const std::string& field)
{
  const auto values = fieldValues(cloud, field);
  return values ? values->values : std::vector<double>{};
}

inline std::string
fieldNames(const pcl::PCLPointCloud2& cloud)
{
  std::string names;
  for (const auto& field : cloud.fields)
    names += (names.empty() ? "" : " ") + field.name;
  return names;
}

/** \return the name of the layout; empty: none */
inline std::string
layoutName(const ScanFolder& scans)
{
  return scans.layout() ? scans.layout()->name : "";
}

/** \brief Tests of data sets in a temporary folder. */
class DatasetFolder : public testing::Test {
protected:
  std::filesystem::path
  root() const
  {
    return folder_ / "data";
  }

  TempFolder folder_;
};

} // namespace pcl6d::test
