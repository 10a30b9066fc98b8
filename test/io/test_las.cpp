// SPDX-License-Identifier: BSD-3-Clause
#include "las_samples.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_reader.h>

namespace fs = std::filesystem;
using namespace pcl6d;
using namespace pcl6d::test;

namespace {

template <typename T>
T
lasValueOf(const std::string& record, std::size_t place)
{
  T value{};
  std::memcpy(&value, &record[place], sizeof value);
  return value;
}

bool
isMarkedDeleted(const LasSample& sample, const std::string& record)
{
  return sample.format >= 6 ? (record[15] & 4) != 0 : (record[15] & 128) != 0;
}

/** Expects the fields of a point that all formats have. */
void
expectPoint(const LasSample& sample,
            std::size_t i,
            const ScanCloud& scan,
            std::size_t at)
{
  const std::string& record = sample.records[i];
  const auto& cloud = scan.cloud;
  const bool is_new = sample.format >= 6;
  const auto byte = [&](std::size_t place) {
    return static_cast<unsigned char>(record[place]);
  };
  EXPECT_EQ(valueOf<float>(cloud, at, "intensity"),
            lasValueOf<std::uint16_t>(record, 12));
  EXPECT_EQ(valueOf<std::uint8_t>(cloud, at, "return_number"),
            byte(14) & (is_new ? 15 : 7));
  EXPECT_EQ(valueOf<std::uint8_t>(cloud, at, "number_of_returns"),
            is_new ? byte(14) >> 4 : byte(14) >> 3 & 7);
  EXPECT_EQ(valueOf<std::uint8_t>(cloud, at, "classification"),
            is_new ? byte(16) : byte(15) & 31);
  EXPECT_EQ(valueOf<std::uint8_t>(cloud, at, "user_data"), byte(17));
  EXPECT_EQ(valueOf<std::uint16_t>(cloud, at, "point_source_id"),
            lasValueOf<std::uint16_t>(record, is_new ? 20 : 18));
  EXPECT_FLOAT_EQ(valueOf<float>(cloud, at, "scan_angle"),
                  is_new ? 0.006f * lasValueOf<std::int16_t>(record, 18)
                         : lasValueOf<std::int8_t>(record, 16));
}

/** \brief Small steps of the coordinates, so that points lie near, and float does. */
LasSample
nearSample(int format, std::size_t count)
{
  LasSample sample = lasSample(format, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      put(sample.records[i],
          4 * axis,
          static_cast<std::int32_t>((i * 7919 + axis) % 4000));
  return sample;
}

} // namespace

TEST(Las, EveryFormatIsReadWithItsFields)
{
  const TempFolder folder;
  for (int format = 0; format <= 10; ++format) {
    SCOPED_TRACE(format);
    const LasSample sample = nearSample(format, 300);
    replaceText(folder / "a.las", lasBytes(sample));
    const Scan scan = readScan(folder / "a.las");
    ASSERT_EQ(scan.points.size(), 300U);
    const io::LasLayout layout = io::lasLayoutOf(format);
    for (std::size_t i = 0; i < 300; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(scan.points[i][axis], static_cast<float>(sample.coordinate(i, axis)));
      expectPoint(sample, i, scan, i);
      if (layout.time > 0) {
        const auto time = lasValueOf<std::int64_t>(sample.records[i], layout.time);
        EXPECT_EQ(valueOf<std::int64_t>(scan.cloud, i, "gps_time"), time);
      }
      for (std::size_t c = 0; layout.colours > 0 && c < 3; ++c) {
        EXPECT_EQ(
            valueOf<std::uint8_t>(scan.cloud, i, "rgb", 2 - c),
            lasValueOf<std::uint16_t>(sample.records[i], layout.colours + 2 * c) >> 8);
      }
      if (layout.infrared > 0) {
        EXPECT_EQ(valueOf<std::uint16_t>(scan.cloud, i, "nir"),
                  lasValueOf<std::uint16_t>(sample.records[i], layout.infrared));
      }
    }
    EXPECT_EQ(scan.left_out.size(), layout.has_waveform ? 1U : 0U);
  }
}

TEST(Las, ColoursOfEightBitsAreTakenAsTheyAre)
{
  const TempFolder folder;
  LasSample sample = nearSample(2, 2);
  for (std::size_t c = 0; c < 3; ++c) {
    put(sample.records[0], 20 + 2 * c, static_cast<std::uint16_t>(10 + c));
    put(sample.records[1], 20 + 2 * c, static_cast<std::uint16_t>(255 - c));
  }
  writeText(folder / "a.las", lasBytes(sample));
  const Scan scan = readScan(folder / "a.las");
  EXPECT_EQ(valueOf<std::uint32_t>(scan.cloud, 0, "rgb"), 0x0a0b0cU);
  EXPECT_EQ(valueOf<std::uint32_t>(scan.cloud, 1, "rgb"), 0xfffefdU);
}

TEST(Las, PointsMarkedAsDeletedAreLeftOutAndTold)
{
  const TempFolder folder;
  for (const int format : {1, 7}) {
    LasSample sample = nearSample(format, 10);
    for (const std::size_t i : {2U, 5U})
      sample.records[i][15] = static_cast<char>(format == 1 ? 128 | 2 : 4);
    replaceText(folder / "a.las", lasBytes(sample));
    const Scan scan = readScan(folder / "a.las");
    ASSERT_EQ(scan.points.size(), 8U);
    ASSERT_EQ(scan.left_out.size(), 1U);
    EXPECT_EQ(scan.left_out[0], "2 points marked as deleted ('withheld')");
    std::size_t at = 0;
    for (std::size_t i = 0; i < 10; ++i)
      if (!isMarkedDeleted(sample, sample.records[i])) {
        EXPECT_EQ(scan.points[at++].x(), static_cast<float>(sample.coordinate(i, 0)));
      }
  }
  LasSample old = nearSample(0, 3); // LAS 1.0 has no such mark
  old.minor = 0;
  old.records[1][15] = static_cast<char>(130);
  replaceText(folder / "a.las", lasBytes(old));
  EXPECT_EQ(
      valueOf<std::uint8_t>(readScan(folder / "a.las").cloud, 1, "classification"),
      130);
}

TEST(Las, NationalCoordinatesKeepTheirDigits)
{
  const TempFolder folder;
  LasSample sample = nearSample(6, 500);
  sample.offset[0] = 512345;
  sample.offset[1] = 5403210;
  for (const std::string& bytes : {lasBytes(sample), lazBytes(sample)}) {
    replaceText(folder / "a.laz", bytes); // either is told by its content
    const ScanCloud scan = readScanCloud(folder / "a.laz");
    for (std::size_t i = 0; i < 500; ++i) {
      EXPECT_EQ(valueOf<double>(scan.cloud, i, "x"), sample.coordinate(i, 0));
      EXPECT_EQ(valueOf<double>(scan.cloud, i, "y"), sample.coordinate(i, 1));
    }
    const ScanFolder scans(folder.path());
    ASSERT_TRUE(scans.moved());
    const Scan near = scans.read(0);
    const Eigen::Isometry3d pose = scans.initialPose(0);
    for (std::size_t i = 0; i < 500; ++i) {
      const Eigen::Vector3d p = pose * near.points[i].cast<double>();
      for (int axis = 0; axis < 3; ++axis) // float within 40 m
        EXPECT_NEAR(p[axis], sample.coordinate(i, axis), 40 * 0x1p-24);
    }
  }
}

TEST(Las, AFirstPointNearTheOriginDoesNotCostTheDigitsOfTheOthers)
{
  const TempFolder folder;
  LasSample sample = nearSample(0, 500);
  sample.offset[0] = 600000;
  put(sample.records[0], 0, std::int32_t{-600000000}); // by the scale of 0.001
  writeText(folder / "a.las", lasBytes(sample));
  const ScanCloud scan = readScanCloud(folder / "a.las");
  EXPECT_EQ(valueOf<double>(scan.cloud, 499, "x"), sample.coordinate(499, 0));
}

TEST(Las, CountsOfOldAndNewHeadersAreUnderstood)
{
  const TempFolder folder;
  const LasSample sample = nearSample(1, 40);
  std::string bytes = lasBytes(sample);
  bytes[25] = 1; // LAS 1.1
  replaceText(folder / "a.las", bytes);
  EXPECT_EQ(readScan(folder / "a.las").points.size(), 40U);
  LasSample late = sample;
  late.minor = 4;
  bytes = lasBytes(late);
  put(bytes, 107, std::uint32_t{0});
  replaceText(folder / "a.las", bytes);
  EXPECT_EQ(readScan(folder / "a.las").points.size(), 40U);
  put(bytes, 107, std::uint32_t{40});
  put(bytes, 247, std::uint64_t{0});
  replaceText(folder / "a.las", bytes);
  EXPECT_EQ(readScan(folder / "a.las").points.size(), 40U);
}

TEST(Las, RecordsThatMakeNoSenseAndWhatFollowsThePointsDoNoHarm)
{
  const TempFolder folder;
  LasSample sample = nearSample(6, 30);
  sample.num_vlrs = 3'000'000'000U;
  sample.vlrs = vlrOf("LASF_Projection", 2112, "PROJCS[]") + std::string(60, '\xff');
  sample.behind = std::string(60 + 500, '\x5a'); // an EVLR
  for (const std::string& bytes : {lasBytes(sample), lazBytes(nearSample(6, 30))}) {
    replaceText(folder / "a.las", bytes);
    EXPECT_EQ(readScan(folder / "a.las").points.size(), 30U);
  }
  replaceText(folder / "a.las", lasBytes(sample));
  const std::vector<std::string> told = {
      "its coordinate reference system",
      "2999999999 records of the header: too many to fit before the points"};
  EXPECT_EQ(readScan(folder / "a.las").left_out, told);
}

TEST(Las, FurtherBytesOfPointsAreTold)
{
  const TempFolder folder;
  const LasSample sample = lasSample(3, 20, 5);
  for (const std::string& bytes : {lasBytes(sample), lazBytes(sample)}) {
    replaceText(folder / "a.las", bytes);
    const Scan scan = readScan(folder / "a.las");
    EXPECT_EQ(scan.points.size(), 20U);
    ASSERT_EQ(scan.left_out.size(), 1U);
    EXPECT_EQ(scan.left_out[0], "5 further bytes of each point");
  }
}

TEST(Las, AFileWithoutPointsIsAnEmptyScan)
{
  const TempFolder folder;
  LasSample sample;
  for (const int format : {0, 7}) {
    sample.format = format;
    replaceText(folder / "a.las", lasBytes(sample));
    EXPECT_TRUE(readScan(folder / "a.las").points.empty());
  }
}
