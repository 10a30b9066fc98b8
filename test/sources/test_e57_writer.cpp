// SPDX-License-Identifier: BSD-3-Clause
// What is written is read back, to the last bit where the format has a place for it.
#include "sources/made_e57.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/e57_source.h>
#include <pcl6d/sources/e57_writer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace pcl6d::test;
using pcl::PCLPointField;
using pcl6d::E57Source;
using pcl6d::E57Station;
using pcl6d::writeE57;

/** \return a cloud of random points with a field of each kind */
pcl::PCLPointCloud2
richCloud(std::size_t count, std::uint8_t type, unsigned seed)
{
  std::mt19937 random(seed);
  const auto column = [&](double scale, double offset) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(static_cast<double>(random()) / 4294967296.0 * scale + offset);
    return values;
  };
  pcl::PCLPointCloud2 cloud;
  cloud.width = static_cast<pcl::uindex_t>(count);
  cloud.height = 1;
  for (const char* const axis : {"x", "y", "z"})
    pcl6d::addField(cloud, axis, type, column(100, -50));
  pcl6d::addField(cloud, "intensity", PCLPointField::FLOAT32, column(1, 0));
  pcl6d::addField(cloud, "normal_x", PCLPointField::FLOAT32, column(2, -1));
  pcl6d::addField(cloud, "normal_y", PCLPointField::FLOAT32, column(2, -1));
  pcl6d::addField(cloud, "normal_z", PCLPointField::FLOAT32, column(2, -1));
  pcl6d::addField(cloud, "time", PCLPointField::FLOAT64, column(1e3, 0));
  pcl6d::addField(cloud, "return_index", PCLPointField::INT32, column(5, 0));
  pcl6d::addField(cloud, "rgb", PCLPointField::UINT32, column(16777216, 0));
  return cloud;
}

void
expectSameField(const pcl::PCLPointCloud2& a,
                const pcl::PCLPointCloud2& b,
                const std::string& name)
{
  const auto in_a = pcl6d::fieldValues(a, name), in_b = pcl6d::fieldValues(b, name);
  ASSERT_TRUE(in_a && in_b) << name;
  EXPECT_EQ(in_a->values, in_b->values) << name;
}

Eigen::Isometry3d
anyPose(double i)
{
  return pcl6d::poseFromEuler({1e6 + i, -3.25, 1.0 / 3}, {0.1 * i, -0.2, 3.0});
}

TEST(E57Writer, ScansComeBackToTheLastBit)
{
  const TempFolder folder;
  for (const std::uint8_t type : {PCLPointField::FLOAT32, PCLPointField::FLOAT64}) {
    std::vector<E57Station> stations;
    for (unsigned i = 0; i < 3; ++i) {
      E57Station station;
      station.name = "Halle <" + std::to_string(i) + "> & \xC3\xBC";
      station.pose = anyPose(i);
      station.stamp = 1.4e9 + i / 3.0;
      station.scan.cloud = richCloud(1 + 4000 * i, type, i);
      stations.push_back(station);
    }
    const auto losses =
        writeE57(folder / "a.e57", 3, [&](std::size_t i) { return stations[i]; });
    EXPECT_EQ(losses, std::vector<std::vector<std::string>>(3));
    EXPECT_EQ(std::filesystem::file_size(folder / "a.e57") % 1024, 0U);
    const E57Source source(folder / "a.e57");
    ASSERT_EQ(source.scans().size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(source.scans()[i].name, stations[i].name);
      EXPECT_EQ(source.scans()[i].stamp, stations[i].stamp);
      constexpr double kRounding = 1e-15; // of the normalised quaternion
      EXPECT_LT((source.scans()[i].pose->linear() - stations[i].pose->linear()).norm(),
                4 * kRounding);
      EXPECT_EQ(source.scans()[i].pose->translation(), stations[i].pose->translation());
      const auto cloud = source.read(i).cloud;
      for (const char* const name :
           {"intensity", "normal_x", "normal_z", "time", "return_index"})
        expectSameField(stations[i].scan.cloud, cloud, name);
      if (type ==
          PCLPointField::FLOAT32) // double is read as float where points are near
        expectSameField(stations[i].scan.cloud, cloud, "y");
      const auto& rgb = cloud.fields.back();
      const auto colours = pcl6d::fieldValues(stations[i].scan.cloud, "rgb")->values;
      for (std::size_t p = 0; p < colours.size(); ++p) {
        std::uint32_t packed = 0;
        std::memcpy(
            &packed, &cloud.data[p * cloud.point_step + rgb.offset], sizeof packed);
        ASSERT_EQ(packed, static_cast<std::uint32_t>(colours[p]));
      }
    }
  }
}

TEST(E57Writer, EqualScansMakeEqualFiles)
{
  const TempFolder folder;
  E57Station station;
  station.scan.cloud = richCloud(500, PCLPointField::FLOAT32, 1);
  const auto same = [&](std::size_t) { return station; };
  writeE57(folder / "a.e57", 2, same);
  writeE57(folder / "b.e57", 2, same);
  EXPECT_EQ(readText(folder / "a.e57"), readText(folder / "b.e57"));
}

TEST(E57Writer, SectionsBeginAtMultiplesOfFourBytes)
{
  const TempFolder folder;
  writeE57(folder / "a.e57", 9, [](std::size_t i) {
    E57Station station;
    station.name = std::string(i, 'n');
    station.scan.cloud = richCloud(100 + i, PCLPointField::FLOAT32, 1);
    return station;
  });
  pcl6d::sources::PageReader file(folder / "a.e57");
  EXPECT_EQ(file.header().xml_offset % 4, 0U);
  for (const auto& scan : pcl6d::sources::readE57Layout(file))
    EXPECT_EQ(scan.offset % 4, 0U);
}

TEST(E57Writer, PointsThatAreNotFiniteAreMarkedAndRowsAreKept)
{
  const TempFolder folder;
  E57Station station;
  auto& cloud = station.scan.cloud;
  cloud = richCloud(12, PCLPointField::FLOAT32, 2);
  cloud.width = 4;
  cloud.height = 3;
  const float nan = std::nanf("");
  std::memcpy(&cloud.data[5 * cloud.point_step], &nan, sizeof nan);
  writeE57(folder / "a.e57", 1, [&](std::size_t) { return station; });
  const auto back = E57Source(folder / "a.e57").read(0).cloud;
  EXPECT_EQ(back.width, 4U);
  EXPECT_EQ(back.height, 3U);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_EQ(std::isnan(pcl6d::fieldValues(back, "x")->values[i]), i == 5);
  // A scan that was read lost that point, and says where the others stood.
  station.scan = pcl6d::finiteScan(cloud, "a");
  ASSERT_EQ(station.scan.places.size(), 11U);
  writeE57(folder / "b.e57", 1, [&](std::size_t) { return station; });
  const auto again = E57Source(folder / "b.e57").read(0).cloud;
  EXPECT_EQ(again.height, 3U);
  EXPECT_EQ(pcl6d::fieldValues(again, "x")->values[7],
            pcl6d::fieldValues(back, "x")->values[7]);
}

TEST(E57Writer, WhatTheFileDoesNotHoldIsTold)
{
  const TempFolder folder;
  E57Station station;
  station.scan.cloud = richCloud(3, PCLPointField::FLOAT32, 2);
  pcl6d::addField(station.scan.cloud, "ring", PCLPointField::UINT16, {1, 2, 3});
  const auto losses =
      writeE57(folder / "a.e57", 1, [&](std::size_t) { return station; });
  EXPECT_EQ(losses[0], std::vector<std::string>{"dropped field 'ring'"});
}

TEST(E57Writer, NamesThatAreNoTextAreWrittenAsFarAsXmlHoldsThem)
{
  const TempFolder folder;
  E57Station station;
  station.name = "a\x01\xFF\xC0\xAF\xED\xA0\x80z";
  station.scan.cloud = richCloud(3, PCLPointField::FLOAT32, 2);
  writeE57(folder / "a.e57", 1, [&](std::size_t) { return station; });
  EXPECT_EQ(E57Source(folder / "a.e57").scans()[0].name, "a ??????z");
}

TEST(E57Writer, CloudsThatAreNoneAreTheCallersMistakeAndLeaveNoFile)
{
  const TempFolder folder;
  E57Station station;
  station.scan.cloud = richCloud(3, PCLPointField::FLOAT32, 2);
  auto write = [&] {
    writeE57(folder / "a.e57", 1, [&](std::size_t) { return station; });
  };
  station.scan.cloud.data.pop_back();
  EXPECT_THROW(write(), pcl6d::BadArgument);
  station.scan.cloud = richCloud(3, PCLPointField::FLOAT32, 2);
  station.scan.cloud.fields[0].offset = station.scan.cloud.point_step;
  EXPECT_THROW(write(), pcl6d::BadArgument);
  station.scan.cloud.fields.erase(station.scan.cloud.fields.begin());
  EXPECT_THROW(write(), pcl6d::BadArgument);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

} // namespace
