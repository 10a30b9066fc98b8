// SPDX-License-Identifier: BSD-3-Clause
#include "las_samples.h"
#include "scan_samples.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/scan_writer.h>

#include <limits>

namespace fs = std::filesystem;
using namespace pcl6d;
using namespace pcl6d::test;
using pcl::PCLPointField;

namespace {

constexpr double kStep = 1e-4;                 // [m] of coordinates that are written
constexpr double kRounding = kStep / 2 + 1e-9; // [m] with what double adds

/** \return points within so many metres, with intensity 0 to 255 */
pcl::PCLPointCloud2
roomCloud(std::size_t count, double size)
{
  Random random(count);
  pcl::PCLPointCloud2 cloud;
  cloud.width = static_cast<pcl::uindex_t>(count);
  cloud.height = 1;
  for (const char* const axis : {"x", "y", "z"}) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(random.uniform(-size / 2, size / 2));
    addField(cloud, axis, PCLPointField::FLOAT32, values);
  }
  std::vector<double> intensities;
  for (std::size_t i = 0; i < count; ++i)
    intensities.push_back(std::floor(random.uniform(0, 256)));
  addField(cloud, "intensity", PCLPointField::FLOAT32, intensities);
  return cloud;
}

const char* const kFiles[] = {"a.las", "a.laz"};

} // namespace

TEST(LasWriter, PointsComeBackToATenthOfAMillimetre)
{
  const TempFolder folder;
  const auto cloud = roomCloud(60000, 80); // more than a chunk
  const Points points = coordinatesOf(cloud);
  for (const char* const name : kFiles) {
    const auto losses = writeScan(folder / name, cloud);
    EXPECT_EQ(losses, std::vector<std::string>{"rounded x, y, z to 1e-04 m"});
    const Scan scan = readScan(folder / name);
    ASSERT_EQ(scan.points.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      // float within 40 m adds its own rounding
      ASSERT_LT((scan.points[i] - points[i]).cwiseAbs().maxCoeff(), kRounding + 4e-6);
      ASSERT_EQ(valueOf<float>(scan.cloud, i, "intensity"),
                valueOf<float>(cloud, i, "intensity"));
      ASSERT_EQ(valueOf<std::uint8_t>(scan.cloud, i, "return_number"), 1);
    }
  }
  EXPECT_LT(2 * fs::file_size(folder / "a.laz"), fs::file_size(folder / "a.las"));
}

TEST(LasWriter, SmallThingsGetAFinerScale)
{
  const TempFolder folder;
  const auto cloud = roomCloud(100, 0.2);
  const Points points = coordinatesOf(cloud);
  for (const char* const name : kFiles) {
    EXPECT_EQ(writeScan(folder / name, cloud)[0], "rounded x, y, z to 1e-06 m");
    const Scan scan = readScan(folder / name);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((scan.points[i] - points[i]).cwiseAbs().maxCoeff(), 6e-7);
  }
}

TEST(LasWriter, PosesBringPointsIntoTheWorldWithAllDigits)
{
  const TempFolder folder;
  const auto cloud = roomCloud(200, 30);
  const Points points = coordinatesOf(cloud);
  Eigen::Isometry3d pose(Eigen::Translation3d(512345.25, 5403210.5, 317));
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  for (const char* const name : kFiles) {
    writeScan(folder / name, cloud, pose);
    const ScanCloud scan = readScanCloud(folder / name);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d wanted = pose * points[i].cast<double>();
      EXPECT_NEAR(valueOf<double>(scan.cloud, i, "x"), wanted.x(), kRounding);
      EXPECT_NEAR(valueOf<double>(scan.cloud, i, "y"), wanted.y(), kRounding);
      EXPECT_NEAR(valueOf<double>(scan.cloud, i, "z"), wanted.z(), kRounding);
    }
  }
}

TEST(LasWriter, ScanIsThePointSourceAndWhatIsDynamicIsClassEighteen)
{
  const TempFolder folder;
  auto cloud = roomCloud(4, 10);
  addField(cloud, "scan", PCLPointField::UINT32, {0, 7, 65535, 65536});
  addField(cloud, "dynamic", PCLPointField::UINT32, {0, 1, 0, 1});
  addField(cloud, "ring", PCLPointField::UINT16, {1, 2, 3, 4});
  for (const char* const name : kFiles) {
    const auto losses = writeScan(folder / name, cloud);
    const std::vector<std::string> wanted = {
        "dropped field 'ring'",
        "rounded x, y, z to 1e-05 m",
        "rounded attributes to whole numbers of their ranges"}; // scan 65536
    EXPECT_EQ(losses, wanted);
    const ScanCloud scan = readScanCloud(folder / name);
    const std::uint16_t sources[] = {0, 7, 65535, 65535};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(valueOf<std::uint16_t>(scan.cloud, i, "point_source_id"), sources[i]);
      EXPECT_EQ(valueOf<std::uint8_t>(scan.cloud, i, "classification"), i % 2 ? 18 : 0);
    }
  }
}

TEST(LasWriter, WhatWasReadIsWrittenAgain)
{
  const TempFolder folder;
  LasSample sample = lasSample(7, 3000);
  for (std::size_t i = 0; i < sample.records.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      put(sample.records[i],
          4 * axis,
          static_cast<std::int32_t>((i * 7919 + axis) % 40000));
    for (std::size_t c = 0; c < 3; ++c) // of 8 bits, as a cloud keeps them
      sample.records[i][30 + 2 * c] = 0;
    sample.records[i][15] = 0; // flags are not kept
    if (sample.records[i][18 + 1] < 0)
      put(sample.records[i], 18, std::int16_t{-300});
  }
  writeText(folder / "a.las", lasBytes(sample));
  const ScanCloud first = readScanCloud(folder / "a.las");
  for (const char* const name : {"b.las", "b.laz"}) {
    writeScan(folder / name, first.cloud);
    const ScanCloud again = readScanCloud(folder / name);
    ASSERT_EQ(again.cloud.data.size(), first.cloud.data.size());
    const std::size_t place = 12; // x y z may be rounded
    for (std::size_t i = 0; i < first.cloud.width; ++i)
      ASSERT_EQ(std::memcmp(&first.cloud.data[i * first.cloud.point_step + place],
                            &again.cloud.data[i * first.cloud.point_step + place],
                            first.cloud.point_step - place),
                0)
          << "point " << i;
  }
}

TEST(LasWriter, IntensityOfFractionsFillsSixteenBits)
{
  const TempFolder folder;
  const auto cloud = floatCloud({{0, 0, 0, 0.25F}, {1, 1, 1, 1}, {2, 0, 0, 0}});
  writeScan(folder / "a.laz", cloud);
  const ScanCloud scan = readScanCloud(folder / "a.laz");
  EXPECT_EQ(valueOf<float>(scan.cloud, 0, "intensity"), 16384);
  EXPECT_EQ(valueOf<float>(scan.cloud, 1, "intensity"), 65535);
}

TEST(LasWriter, PointsThatAreNotFiniteAreLeftOutAndTold)
{
  const TempFolder folder;
  const float inf = std::numeric_limits<float>::infinity();
  const auto cloud = floatCloud(
      {{inf, 0, 0, 1}, {1, 2, 3, 4}, {0, std::nanf(""), 0, 1}, {40, 5, 6, 7}});
  for (const char* const name : kFiles) {
    const auto losses = writeScan(folder / name, cloud);
    EXPECT_EQ(losses.at(0), "dropped 2 points with an x, y or z that is not finite");
    const Scan scan = readScan(folder / name);
    ASSERT_EQ(scan.points.size(), 2U);
    EXPECT_LT((scan.points[1] - Eigen::Vector3f(40, 5, 6)).norm(), 1e-5F);
  }
}

TEST(LasWriter, AnEmptyCloudIsAnEmptyFile)
{
  const TempFolder folder;
  for (const char* const name : kFiles) {
    EXPECT_TRUE(writeScan(folder / name, floatCloud({})).empty());
    EXPECT_TRUE(readScan(folder / name).points.empty());
  }
}

TEST(LasWriter, PointsBeyondItsReachAndPipesAreRefused)
{
  const TempFolder folder;
  const auto cloud = floatCloud({{0, 0, 0, 1}, {20, 0, 0, 1}});
  const auto far = floatCloud({{300001, 0, 0, 1}, {0, 0, 0, 1}});
  const ScanShape shape = {cloud.fields, cloud.point_step, 4, 1};
  const std::string message = messageOf<BadArgument>([&] {
    writeScanBlocks(folder / "a.las", shape, {}, [&](const ScanSink& sink) {
      sink(cloud);
      sink(far);
    });
  });
  EXPECT_EQ(
      message,
      "a point lies at x = 300001 m, but in steps of 1e-04 m LAS reaches only 214748 "
      "m from 10, where the first points lie");
  EXPECT_FALSE(fs::exists(folder / "a.las"));
  EXPECT_EQ(messageOf<IoFailed>([&] {
              writeScan("/dev/null",
                        cloud,
                        Eigen::Isometry3d::Identity(),
                        {ScanFormat::kLaz});
            }),
            "/dev/null: is a pipe, a device or an open file, but the header of LAS and "
            "LAZ is completed at the end; write to a regular file");
}
