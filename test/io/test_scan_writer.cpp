// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"
#include "scan_samples.h"

using pcl6d::PcdEncoding;
using pcl6d::readScanCloud;
using pcl6d::ScanFormat;
using pcl6d::ScanSink;
using pcl6d::ScanWriterOptions;
using pcl6d::writeScan;
using pcl6d::writeScanBlocks;
using pcl6d::test::floatCloud;
using pcl6d::test::kWays;
using pcl6d::test::makeRichCloud;
using pcl6d::test::messageOf;
using pcl6d::test::randomCloud;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::Way;

namespace {
using Strings = std::vector<std::string>;
} // namespace

TEST(ScanWriter, PcdKeepsAllAndPlyAllThatItHasTypesFor)
{
  const TempFolder folder;
  auto cloud = makeRichCloud(10);
  const Eigen::Isometry3d pose(Eigen::Translation3d(1, 2, 3));
  EXPECT_EQ(writeScan(folder / "a.pcd", cloud, pose), Strings{});
  pcl6d::test::expectSameFields(cloud, pcl6d::readPcd(folder / "a.pcd"));
  for (const auto encoding : {PcdEncoding::kAscii, PcdEncoding::kBinary}) {
    EXPECT_EQ(writeScan(folder / "a.ply", cloud, pose, {ScanFormat::kAuto, encoding}),
              (Strings{"split field 'moments' of 3 values into moments_0, ...",
                       "dropped the pose"}));
    const auto read = readScanCloud(folder / "a.ply").cloud;
    ASSERT_EQ(read.width, 9u); // one z is nan
    for (std::size_t i = 0; i < read.width; ++i) {
      const std::size_t k = i + (i >= 1);
      EXPECT_EQ(valueOf<float>(read, i, "z"), valueOf<float>(cloud, k, "z"));
      EXPECT_EQ(valueOf<std::uint32_t>(read, i, "rgb"),
                valueOf<std::uint32_t>(cloud, k, "rgb") & 0xffffff);
      EXPECT_EQ(valueOf<std::uint32_t>(read, i, "label"),
                valueOf<std::uint32_t>(cloud, k, "label"));
      EXPECT_EQ(valueOf<float>(read, i, "moments_2"),
                valueOf<float>(cloud, k, "moments", 2));
      EXPECT_EQ(valueOf<double>(read, i, "time"), valueOf<double>(cloud, k, "time"));
      EXPECT_EQ(valueOf<std::uint8_t>(read, i, "ring"),
                valueOf<std::uint8_t>(cloud, k, "ring"));
      EXPECT_EQ(valueOf<std::int16_t>(read, i, "tilt"),
                valueOf<std::int16_t>(cloud, k, "tilt"));
    }
  }
  cloud.fields[5].datatype = pcl::PCLPointField::INT64; // label
  cloud.fields[3].name = "rgba";
  cloud.fields[3].datatype = pcl::PCLPointField::UINT32;
  cloud.fields[4].name = "normal_x";
  EXPECT_EQ(writeScan(folder / "a.ply", cloud).front(),
            "dropped field 'label', a 64-bit integer");
  const auto read = readScanCloud(folder / "a.ply").cloud;
  EXPECT_EQ(valueOf<std::uint32_t>(read, 0, "rgba"), 0xff902030u);
  EXPECT_EQ(valueOf<float>(read, 0, "normal_x"), 1);
}

TEST(ScanWriter, TellsWhatTheFormatsOfFloatsDoNotHold)
{
  const TempFolder folder;
  auto cloud = makeRichCloud(6);
  cloud.width = 2;
  cloud.height = 3;
  EXPECT_EQ(writeScan(folder / "a.xyz", cloud),
            (Strings{"dropped field 'rgb'",
                     "dropped field 'intensity'",
                     "dropped field 'label'",
                     "dropped field 'moments'",
                     "dropped field 'time'",
                     "dropped field 'ring'",
                     "dropped field 'tilt'",
                     "dropped the order in 3 rows of 2 points"}));
  EXPECT_EQ(writeScan(folder / "a.bin", cloud).size(), 7u);
  cloud.fields[4].name = "reflectance"; // is the intensity of KITTI and uosr
  EXPECT_EQ(writeScan(folder / "a.bin", cloud).size(), 7u);
  EXPECT_EQ(valueOf<float>(readScanCloud(folder / "a.bin").cloud, 0, "intensity"), 1);
  cloud.fields[4].name = "height";
  for (const auto format : {ScanFormat::kKitti, ScanFormat::kUosr}) {
    EXPECT_EQ(
        writeScan(folder / "a", cloud, Eigen::Isometry3d::Identity(), {format}).front(),
        "wrote 0 for the missing field 'intensity'");
    EXPECT_EQ(valueOf<float>(readScanCloud(folder / "a", format).cloud, 2, "intensity"),
              0);
  }
}

TEST(ScanWriter, DoublesKeepTheirDigitsInTextAndBecomeFloatInKitti)
{
  const TempFolder folder;
  auto cloud = makeRichCloud(1);
  cloud.fields[0].datatype = pcl::PCLPointField::FLOAT64;
  cloud.fields[0].offset = 40; // time
  EXPECT_EQ(writeScan(folder / "a.bin", cloud).back(), "rounded field 'x' to float32");
  writeScan(folder / "a.xyz", cloud);
  EXPECT_EQ(readText(folder / "a.xyz"), "1317384506.40528 -0 0\n");
  writeScan(folder / "a.3d", cloud);
  EXPECT_EQ(readText(folder / "a.3d"), "0 0 131738450640.528\n");
}

TEST(ScanWriter, CentimetresAreTheMetresWithTheirPointMoved)
{
  const TempFolder folder;
  writeScan(folder / "a.3d",
            floatCloud({{0.1234f, -12.5f, 3, 0},
                        {1e-8f, 1e30f, 0.00054f, 0},
                        {-0.f, 1.f, 123456.7f, 0}}));
  EXPECT_EQ(readText(folder / "a.3d"),
            "1250 300 12.34\n-1e32 0.054 1e-6\n-100 12345670 -0\n");
}

TEST(ScanWriter, BlocksGiveTheSameFileAsTheWhole)
{
  const TempFolder folder;
  const auto whole = randomCloud(20000, false);
  for (const Way& way : kWays) {
    SCOPED_TRACE(way.name);
    const ScanWriterOptions options{way.format, way.encoding};
    writeScan(folder / "whole", whole, Eigen::Isometry3d::Identity(), options);
    const pcl6d::ScanShape shape{whole.fields, whole.point_step, 20000};
    writeScanBlocks(folder / "blocks", shape, options, [&](const ScanSink& sink) {
      for (const auto& [begin, end] : {std::pair{0, 1}, {1, 9000}, {9000, 20000}}) {
        auto block = whole;
        block.width = static_cast<pcl::uindex_t>(end - begin);
        block.data.assign(whole.data.begin() + begin * 16,
                          whole.data.begin() + end * 16);
        sink(block);
      }
    });
    EXPECT_EQ(readText(folder / "whole"), readText(folder / "blocks"));
  }
}

TEST(ScanWriter, RefusesWhatIsNoScanAndLeavesNoFile)
{
  const TempFolder folder;
  const auto refuse = [&](const pcl::PCLPointCloud2& cloud,
                          const ScanWriterOptions& options) {
    return messageOf<pcl6d::BadArgument>([&] {
      writeScan(folder / "a", cloud, Eigen::Isometry3d::Identity(), options);
    });
  };
  const auto cloud = makeRichCloud(2);
  EXPECT_EQ(refuse(cloud, {}),
            "no format of scans has the extension '' (known: .pcd .ply .3d .bin .xyz "
            ".las .laz .ptx .pts .csv .txt .asc)");
  for (const auto format : {ScanFormat::kXyz, ScanFormat::kUos, ScanFormat::kKitti}) {
    auto flat = cloud;
    flat.fields[2].name = "depth";
    EXPECT_EQ(refuse(flat, {format}), "the cloud has no field 'z' of floating point");
    flat = cloud;
    flat.fields[1].datatype = pcl::PCLPointField::INT32;
    EXPECT_EQ(refuse(flat, {format}), "the cloud has no field 'y' of floating point");
  }
  auto broken = cloud;
  broken.data.resize(10);
  EXPECT_EQ(refuse(broken, {ScanFormat::kPly}),
            "the cloud holds 10 bytes, but 2 points of 56 bytes");
  const pcl6d::ScanShape shape{cloud.fields, cloud.point_step, 3};
  EXPECT_EQ(messageOf<pcl6d::BadArgument>([&] {
              writeScanBlocks(folder / "a",
                              shape,
                              {ScanFormat::kXyz},
                              [&](const ScanSink& sink) { sink(cloud); });
            }),
            "the scan has 3 points, but 2 were handed over");
  EXPECT_EQ(messageOf<pcl6d::BadArgument>([&] {
              writeScanBlocks(folder / "a",
                              {cloud.fields, cloud.point_step, 1},
                              {ScanFormat::kPcd},
                              [&](const ScanSink& sink) { sink(cloud); });
            }),
            "the scan has 1 point, but 2 were handed over");
  EXPECT_EQ(messageOf<pcl6d::BadArgument>([&] {
              writeScanBlocks(
                  folder / "a", shape, {ScanFormat::kXyz}, [&](const ScanSink& sink) {
                    sink(floatCloud({{1, 2, 3, 4}}));
                  });
            }),
            "a block has points of 16 bytes, but the scan of 56");
  EXPECT_TRUE(pcl6d::test::namesIn(folder.path()).empty());
}

TEST(ScanWriter, AFullDiskIsNamedAndLeavesNoFile)
{
  const TempFolder folder;
  const auto full = pcl6d::test::fullDevice(folder);
  for (const Way& way : kWays)
    pcl6d::test::expectIoFailed(full, "No space left on device", [&] {
      writeScan(full,
                randomCloud(5000, false),
                Eigen::Isometry3d::Identity(),
                {way.format, way.encoding});
    });
}

TEST(ScanWriter, FormatsThatAreOnlyReadAreRefused)
{
  const pcl6d::test::TempFolder folder;
  for (const char* const name : {"a.csv", "a.pts", "a.txt"}) {
    EXPECT_FALSE(pcl6d::isWritten(pcl6d::scanFormatOfExtension(name)));
    EXPECT_THROW(pcl6d::writeScan(folder / name, pcl6d::test::randomCloud(3, false)),
                 pcl6d::BadArgument);
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
  EXPECT_TRUE(pcl6d::isWritten(pcl6d::ScanFormat::kPtx));
}
