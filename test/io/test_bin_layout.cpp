// SPDX-License-Identifier: BSD-3-Clause
// What a point of a .bin file is, recognised or named.
#include "io_test.h"
#include "scan_samples.h"

#include <pcl6d/io/scan_reader.h>

#include <cmath>

using pcl6d::BinLayout;
using pcl6d::ScanReaderOptions;
using pcl6d::test::bytesOf;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::replaceText;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;

namespace {

constexpr std::size_t kPoints = 2000; // divisible by the sizes of all layouts

class BinLayoutTest : public testing::Test {
protected:
  /** Writes points of a scanner with 16 rings in a room of 10 m x 6 m x 3 m; ring after ring, or
   * firing after firing. */
  void
  write(const std::string& columns, bool by_ring)
  {
    pcl6d::Random random(7);
    std::vector<float> values;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::size_t ring = by_ring ? i / (kPoints / 16) : i % 16;
      const std::size_t shot = by_ring ? i % (kPoints / 16) : i / 16;
      const double turn = 2 * M_PI * static_cast<double>(shot) / (kPoints / 16.0);
      const double tilt = (static_cast<double>(ring) - 8) * M_PI / 90;
      const double range = std::min(5 / std::max(0.01, std::abs(std::cos(turn))),
                                    3 / std::max(0.01, std::abs(std::sin(turn))));
      for (const char column : columns)
        switch (column) {
        case 'x':
          values.push_back(static_cast<float>(range * std::cos(turn)));
          break;
        case 'y':
          values.push_back(static_cast<float>(range * std::sin(turn)));
          break;
        case 'z':
          values.push_back(static_cast<float>(range * std::tan(tilt)));
          break;
        case 'i':
          values.push_back(
              static_cast<float>(static_cast<int>(random.uniform(0, 100))));
          break;
        case 'r':
          values.push_back(static_cast<float>(ring));
          break;
        default:
          values.push_back(static_cast<float>(i) * 1e-5f);
        }
    }
    replaceText(file_, bytesOf<float>(values));
  }

  std::string
  fields(BinLayout layout = BinLayout::kAuto)
  {
    ScanReaderOptions options;
    options.bin_layout = layout;
    const auto scan = pcl6d::readScanCloud(file_, options);
    std::string names;
    for (const auto& field : scan.cloud.fields)
      names += field.name + " ";
    return names + std::to_string(scan.cloud.width);
  }

  TempFolder folder_;
  const std::filesystem::path file_ = folder_ / "scan.bin";
};
} // namespace

TEST_F(BinLayoutTest, TheLayoutIsRecognised)
{
  for (const bool by_ring : {true, false}) {
    SCOPED_TRACE(by_ring);
    write("xyz", by_ring);
    EXPECT_EQ(fields(), "x y z 2000");
    write("xyzi", by_ring);
    EXPECT_EQ(fields(), "x y z intensity 2000");
    write("xyzir", by_ring);
    EXPECT_EQ(fields(), "x y z intensity ring 2000");
    write("xyzit", by_ring);
    EXPECT_EQ(fields(), "x y z intensity time 2000");
    write("xyzirt", by_ring);
    EXPECT_EQ(fields(), "x y z intensity ring time 2000");
  }
}

TEST_F(BinLayoutTest, TheLayoutMayBeNamed)
{
  write("xyzi", true); // 32 000 bytes
  EXPECT_EQ(fields(BinLayout::kXyzir), "x y z intensity ring 1600");
  EXPECT_EQ(fields(BinLayout::kNclt), "x y z intensity ring 4000");
  expectIoFailed(file_,
                 "its size of 32000 bytes is not a multiple of 12 (--bin-layout xyz)",
                 [&] { fields(BinLayout::kXyz); });
  EXPECT_EQ(pcl6d::binLayoutFromName("xyzirt"), BinLayout::kXyzirt);
  EXPECT_EQ(messageOf<pcl6d::BadArgument>([] { pcl6d::binLayoutFromName("xyzq"); }),
            "bin-layout = 'xyzq', but must be auto, xyz, xyzi, xyzir, xyzit, xyzirt, "
            "nclt, helipr-avia, helipr-aeva, helipr-ouster or helipr-velodyne");
}

TEST_F(BinLayoutTest, NcltIsConvertedToOurFrame)
{
  pcl6d::Random random(3);
  std::string bytes;
  for (int i = 0; i < 500; ++i) {
    for (int axis = 0; axis < 3; ++axis) { // within 20 m of the scanner
      const auto steps = static_cast<unsigned>(random.uniform(16000, 24000));
      bytes += static_cast<char>(steps & 0xff);
      bytes += static_cast<char>(steps >> 8);
    }
    bytes += static_cast<char>(77);
    bytes += static_cast<char>(i % 32);
  }
  // 1 m forward, 2 m right, 3 m down
  const std::vector<unsigned> first = {20200, 20400, 20600};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bytes[2 * axis] = static_cast<char>(first[axis] & 0xff);
    bytes[2 * axis + 1] = static_cast<char>(first[axis] >> 8);
  }
  replaceText(file_, bytes);
  const auto scan = pcl6d::readScan(file_);
  ASSERT_EQ(scan.points.size(), 500U);
  // Half a step of float at 100 m, twice.
  EXPECT_LT((scan.points[0] - Eigen::Vector3f(1, -2, -3)).norm(), 1e-5f);
  EXPECT_EQ(valueOf<float>(scan.cloud, 33, "intensity"), 77);
  EXPECT_EQ(valueOf<float>(scan.cloud, 33, "ring"), 1);
}

TEST_F(BinLayoutTest, RandomNumbersAreKittis)
{
  const auto cloud = pcl6d::test::randomCloud(900, false);
  replaceText(file_, std::string(cloud.data.begin(), cloud.data.end()));
  EXPECT_EQ(fields(), "x y z intensity 900");
}

TEST_F(BinLayoutTest, WhatIsNotClearIsNamed)
{
  // Columns differ too little to tell rows of three numbers from a cut file of KITTI.
  std::vector<float> values;
  pcl6d::Random random(5);
  for (std::size_t i = 0; i < 6003; ++i)
    values.push_back(
        static_cast<float>(random.uniform(0, 1) + (i % 3 == 0 ? 0.54 : 0)));
  replaceText(file_, bytesOf<float>(values));
  expectIoFailed(
      file_,
      "its points look like xyz, but the values do not confirm the guess; give the "
      "layout (--bin-layout xyz, xyzi, xyzir, xyzit, xyzirt or nclt)",
      [&] { pcl6d::readScan(file_); });
  EXPECT_EQ(fields(BinLayout::kXyz), "x y z 2001");
}
