// SPDX-License-Identifier: BSD-3-Clause
// Scans by a reader of the caller's: chosen by its extension, and checked.
#include "io_test.h"

#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/scan_folder.h>

#include <limits>
#include <stdexcept>

namespace fs = std::filesystem;
using pcl6d::OtherScanFormat;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
/** \return points (i, 2, 3) as floats, in rows of so many */
pcl::PCLPointCloud2
cloudOf(std::size_t count, pcl::uindex_t height = 1)
{
  pcl::PCLPointCloud2 cloud;
  cloud.width = static_cast<pcl::uindex_t>(count) / height;
  cloud.height = height;
  cloud.point_step = 12;
  for (const char* const name : {"x", "y", "z"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<pcl::uindex_t>(4 * cloud.fields.size());
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i)
    values.insert(values.end(), {static_cast<float>(i), 2, 3});
  cloud.data.resize(4 * values.size());
  if (count > 0)
    std::memcpy(cloud.data.data(), values.data(), cloud.data.size());
  return cloud;
}

void
setX(pcl::PCLPointCloud2& cloud, std::size_t point, float x)
{
  std::memcpy(&cloud.data[point * cloud.point_step], &x, sizeof x);
}

OtherScanFormat
formatOf(const pcl::PCLPointCloud2& cloud)
{
  return {"own", ".own", [cloud](const fs::path&) { return cloud; }};
}
} // namespace

TEST(OtherScanFormat, FilesAreThoseWithItsExtension)
{
  const TempFolder folder;
  for (const char* const name :
       {"scan10.own", "scan2.OWN", "scan1.pcd", "a.owner", ".x.own"})
    writeText(folder / name, "1 2 3\n");
  ScanFolderOptions options;
  std::vector<std::string> read;
  auto format = std::make_shared<OtherScanFormat>(formatOf(cloudOf(5)));
  format->read = [&](const fs::path& file) {
    read.push_back(file.filename());
    return cloudOf(5);
  };
  options.other_format = format;
  options.format = pcl6d::ScanFormat::kPcd; // has no say
  const ScanFolder scans(folder.path(), options);
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans.format(), pcl6d::ScanFormat::kAuto);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(scans.read(i).points.size(), 5u);
  EXPECT_EQ(scans.readCloud(0).cloud.width, 5u);
  EXPECT_EQ(read, (std::vector<std::string>{"scan2.OWN", "scan10.own", "scan2.OWN"}));

  const TempFolder empty;
  writeText(empty / "scan1.pcd", "");
  expectIoFailed(empty.path(), "no scans found (looked for .own)", [&] {
    ScanFolder(empty.path(), options);
  });
}

TEST(OtherScanFormat, PointsThatAreNotFiniteAreDroppedWhateverTheReaderSays)
{
  pcl::PCLPointCloud2 cloud = cloudOf(6, 2);
  setX(cloud, 4, std::numeric_limits<float>::quiet_NaN());
  cloud.is_dense = true; // it is not
  const auto scan = pcl6d::readScanCloud("scan.own", formatOf(cloud));
  EXPECT_EQ(scan.dropped, 1u);
  EXPECT_EQ(scan.cloud.width, 5u);
  EXPECT_EQ(scan.row_length, 3u);
  EXPECT_EQ(scan.places, (std::vector<std::uint32_t>{0, 1, 2, 3, 5}));
  EXPECT_EQ(pcl6d::readScanCloud("scan.own", formatOf(cloudOf(0))).cloud.width, 0u);
}

TEST(OtherScanFormat, CloudsThatDoNotFitTogetherAreRefused)
{
  const auto expectRefused = [](const pcl::PCLPointCloud2& cloud, const char* words) {
    SCOPED_TRACE(words);
    const std::string message = messageOf<pcl6d::IoFailed>(
        [&] { pcl6d::readScanCloud("a/scan.own", formatOf(cloud)); });
    EXPECT_EQ(message.rfind("a/scan.own: ", 0), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  pcl::PCLPointCloud2 cloud = cloudOf(5);
  cloud.width = 1u << 30;
  expectRefused(cloud, "bytes of the cloud = 60");
  cloud = cloudOf(5);
  cloud.data.push_back(0);
  expectRefused(cloud, "bytes of the cloud = 61");
  cloud = cloudOf(5);
  cloud.fields[2].offset = 9;
  expectRefused(cloud, "end of field z = 13");
  cloud = cloudOf(5);
  cloud.fields[1].count = std::numeric_limits<pcl::uindex_t>::max();
  expectRefused(cloud, "end of field y");
  cloud = cloudOf(5);
  cloud.fields.pop_back();
  expectRefused(cloud, "no field 'z'");
  cloud = cloudOf(5);
  cloud.fields[0].datatype = pcl::PCLPointField::INT32;
  expectRefused(cloud, "field 'x'");
  cloud = cloudOf(5);
  cloud.is_bigendian = true;
  expectRefused(cloud, "is_bigendian");
  expectRefused(pcl::PCLPointCloud2(), "no field 'x'");
}

TEST(OtherScanFormat, WhatAReaderThrowsNamesTheFile)
{
  OtherScanFormat format = formatOf(cloudOf(1));
  format.read = [](const fs::path&) -> pcl::PCLPointCloud2 {
    throw std::runtime_error("line 3: odd");
  };
  expectIoFailed("b/scan.own", "format own: line 3: odd", [&] {
    pcl6d::readScanCloud("b/scan.own", format);
  });
  format.read = nullptr;
  EXPECT_THROW(pcl6d::readScanCloud("b/scan.own", format), pcl6d::BadArgument);
}
