// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"
#include "support/poses.h"

#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

using pcl6d::PcdEncoding;
using pcl6d::readPcd;
using pcl6d::readPcdViewpoint;
using pcl6d::writePcd;
using pcl6d::test::expectSameFields;
using pcl6d::test::kEncodings;
using pcl6d::test::makeRichCloud;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::writeText;

namespace {

/** \return colours and normals, which PCL stores with gaps and not in the order of
 * their offsets, so that its binary file has a COUNT of -20 */
pcl::PCLPointCloud2
makeCloudOfPcl()
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> points(4, 3);
  float next = 0.1f;
  for (auto& p : points) {
    p.x = next *= 1.7f;
    p.y = -next;
    p.z = 1 / next;
    p.normal_x = 0.6f;
    p.normal_y = 0.8f;
    p.curvature = next;
    p.rgba = 0xff0a0b0c + static_cast<std::uint32_t>(&p - &points.front());
  }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  return cloud;
}

const Eigen::Isometry3d kNoMotion = Eigen::Isometry3d::Identity();

} // namespace

TEST(PcdIo, EveryEncodingKeepsAllBitsOfAllFields)
{
  const TempFolder folder;
  const auto cloud = makeRichCloud(300);
  for (const auto encoding : kEncodings) {
    SCOPED_TRACE(static_cast<int>(encoding));
    writePcd(folder / "scan.pcd", cloud, kNoMotion, encoding);
    const auto read = readPcd(folder / "scan.pcd");
    expectSameFields(cloud, read);
    EXPECT_EQ(read.row_step, read.width * read.point_step);
    EXPECT_FALSE(read.is_dense); // the z of point 1
  }
}

TEST(PcdIo, PclReadsWhatWeWrite)
{
  const TempFolder folder;
  const auto cloud = makeRichCloud(300);
  for (const auto encoding : kEncodings) {
    SCOPED_TRACE(static_cast<int>(encoding));
    writePcd(folder / "scan.pcd", cloud, kNoMotion, encoding);
    pcl::PCLPointCloud2 read;
    ASSERT_EQ(pcl::io::loadPCDFile((folder / "scan.pcd").string(), read), 0);
    expectSameFields(cloud, read);
  }
}

TEST(PcdIo, WeReadWhatPclWritesOrganizedAndWithGaps)
{
  const TempFolder folder;
  const std::string file = (folder / "scan.pcd").string();
  const auto cloud = makeCloudOfPcl();
  const Eigen::Vector4f origin(1, 2, 3, 0);
  const Eigen::Quaternionf turn(0, 0, 0, 1);
  pcl::PCDWriter writer;
  for (const auto encoding : kEncodings) {
    SCOPED_TRACE(static_cast<int>(encoding));
    if (encoding == PcdEncoding::kAscii)
      writer.writeASCII(file, cloud, origin, turn, 9);
    else if (encoding == PcdEncoding::kBinary)
      writer.writeBinary(file, cloud, origin, turn);
    else
      writer.writeBinaryCompressed(file, cloud, origin, turn);
    expectSameFields(cloud, readPcd(file));
    const auto pose = readPcdViewpoint(file);
    EXPECT_EQ(pose.translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(pose.linear().isApprox(
        Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix(), 1e-15));
  }
}

TEST(PcdIo, TheViewpointKeepsAllDigitsInNationalCoordinates)
{
  const TempFolder folder;
  pcl6d::Random random(1);
  Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 1, 2.0);
  pose.translation() << 691234.567, 5336789.123, 512.4;
  for (const auto encoding : kEncodings) {
    writePcd(folder / "scan.pcd", makeRichCloud(3), pose, encoding);
    const auto read = readPcdViewpoint(folder / "scan.pcd");
    EXPECT_EQ(read.translation(), pose.translation());
    EXPECT_LT(pcl6d::distanceBetween(read, pose).rotation, 1e-14);
  }
}

TEST(PcdIo, TheQuaternionOfTheViewpointIsNormalised)
{
  const TempFolder folder;
  writeText(folder / "scan.pcd",
            "VERSION 0.7\nFIELDS x\nSIZE 4\nTYPE F\nCOUNT 1\nWIDTH 0\nHEIGHT 1\n"
            "VIEWPOINT 1 2 3 0.7071 0 0 0.7071\nPOINTS 0\nDATA ascii\n");
  const auto pose = readPcdViewpoint(folder / "scan.pcd");
  EXPECT_TRUE(pose.isApprox(pcl6d::poseFromEuler({1, 2, 3}, {0, 0, M_PI / 2}), 1e-15));
}

TEST(PcdIo, OldHeadersAreUnderstood)
{
  const TempFolder folder;
  writeText(
      folder / "old.pcd",
      "# .PCD v.5 - Point Cloud Data file format\r\nVERSION .5\r\nCOLUMNS x y z\r\n"
      "SIZE 4 4 4\r\nTYPE F F F\r\nPOINTS 2\r\nDATA ascii\r\n1 2 3\r\n\r\n4 5 6\r\n");
  const auto cloud = readPcd(folder / "old.pcd");
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 1u);
  EXPECT_EQ(valueOf<float>(cloud, 1, "z"), 6.0f);
  EXPECT_TRUE(readPcdViewpoint(folder / "old.pcd").isApprox(kNoMotion, 0));
}

// Drivers write padding of no bytes; PCL drops such fields.
TEST(PcdIo, AGapOfNoBytesIsNoField)
{
  const TempFolder folder;
  writeText(folder / "a.pcd",
            "FIELDS x y z _ ring _\nSIZE 4 4 4 1 1 1\nTYPE F F F U U U\n"
            "COUNT 1 1 1 2 1 0\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n"
            "123412341234..5");
  const auto cloud = readPcd(folder / "a.pcd");
  pcl::PCLPointCloud2 expected;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "a.pcd").string(), expected), 0);
  EXPECT_EQ(cloud.point_step, 15u);
  EXPECT_EQ(cloud.data, expected.data);
  EXPECT_EQ(cloud.fields.back().name, "ring");
  EXPECT_EQ(cloud.fields.back().offset, 14u);
}

TEST(PcdIo, NumbersOfATextBodyComeInAllSpellings)
{
  const TempFolder folder;
  writeText(folder / "scan.pcd",
            "VERSION 0.7\nFIELDS a b c d\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 1\n"
            "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
            "+1.5 \t-2E+2 nan inf\n1e-60 .5 -NaN -Inf\n");
  const auto cloud = readPcd(folder / "scan.pcd");
  EXPECT_EQ(valueOf<float>(cloud, 0, "a"), 1.5f);
  EXPECT_EQ(valueOf<float>(cloud, 0, "b"), -200.0f);
  EXPECT_TRUE(std::isnan(valueOf<float>(cloud, 0, "c")));
  EXPECT_TRUE(std::isinf(valueOf<double>(cloud, 0, "d")));
  EXPECT_EQ(valueOf<float>(cloud, 1, "a"), 0.0f); // too small for a float
  EXPECT_TRUE(std::isnan(valueOf<float>(cloud, 1, "c")));
}

TEST(PcdIo, ADecimalCommaElsewhereChangesNothing)
{
  const TempFolder folder;
  const auto cloud = makeRichCloud(1200);
  const pcl6d::test::DecimalComma locale;
  for (const auto encoding : kEncodings) {
    SCOPED_TRACE(static_cast<int>(encoding));
    Eigen::Isometry3d pose = kNoMotion;
    pose.translation().x() = 12345.625;
    writePcd(folder / "scan.pcd", cloud, pose, encoding);
    expectSameFields(cloud, readPcd(folder / "scan.pcd"));
    EXPECT_EQ(readPcdViewpoint(folder / "scan.pcd").translation().x(), 12345.625);
  }
}

TEST(PcdIo, PointsThatCannotBeCompressedSurvive)
{
  const TempFolder folder;
  pcl6d::Random random(3);
  auto cloud = makeRichCloud(500);
  for (auto& byte : cloud.data)
    byte = static_cast<std::uint8_t>(256 * random.uniform());
  writePcd(folder / "scan.pcd", cloud);
  expectSameFields(cloud, readPcd(folder / "scan.pcd"));
}

TEST(PcdIo, TheSameCloudGivesTheSameFile)
{
  const TempFolder folder;
  const auto cloud = makeRichCloud(2000);
  writePcd(folder / "a.pcd", cloud);
  writePcd(folder / "b.pcd", makeRichCloud(500)); // leaves other bytes on the stack
  writePcd(folder / "b.pcd", cloud);
  EXPECT_EQ(pcl6d::test::readText(folder / "a.pcd"),
            pcl6d::test::readText(folder / "b.pcd"));
}

TEST(PcdIo, AnEmptyCloudIsWrittenAndRead)
{
  const TempFolder folder;
  for (const auto encoding : kEncodings) {
    SCOPED_TRACE(static_cast<int>(encoding));
    writePcd(folder / "scan.pcd", makeRichCloud(0), kNoMotion, encoding);
    const auto cloud = readPcd(folder / "scan.pcd");
    EXPECT_EQ(cloud.width, 0u);
    EXPECT_TRUE(cloud.data.empty());
    EXPECT_EQ(cloud.fields.size(), 10u);
  }
}

TEST(PcdIo, ACloudThatContradictsItselfIsTheCallersMistake)
{
  const TempFolder folder;
  const auto write = [&](const pcl::PCLPointCloud2& cloud) {
    return messageOf<pcl6d::BadArgument>([&] { writePcd(folder / "scan.pcd", cloud); });
  };
  auto cloud = makeRichCloud(3);
  cloud.data.pop_back();
  EXPECT_EQ(write(cloud), "the cloud holds 167 bytes, but 3 points of 56 bytes");
  cloud = makeRichCloud(3);
  cloud.fields.back().offset = 55;
  EXPECT_EQ(
      write(cloud),
      "field 'tilt' of the cloud has an unknown type or does not fit into a point");
  cloud.fields.clear();
  EXPECT_EQ(write(cloud), "the cloud has no field");
  EXPECT_TRUE(pcl6d::test::namesIn(folder.path()).empty());
}

TEST(PcdIo, AFileThatCannotBeWrittenIsNamed)
{
  const TempFolder folder;
  const auto full = pcl6d::test::fullDevice(folder);
  pcl6d::test::expectIoFailed(
      full, "No space left on device", [&] { writePcd(full, makeRichCloud(10000)); });
}
