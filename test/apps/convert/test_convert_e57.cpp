// SPDX-License-Identifier: BSD-3-Clause
// E57 to the other formats and back.
#include "apps/convert/convert_test.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/sources/e57_source.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl6d::test;
namespace fs = std::filesystem;

/** \brief Three scans with poses and their E57 file. */
class ConvertE57 : public testing::Test {
protected:
  ConvertE57()
  {
    fs::create_directory(folder_ / "in");
    for (int i = 0; i < 3; ++i)
      pcl6d::writePcd(folder_ / "in" / ("hall" + std::to_string(i) + ".pcd"),
                      cloudOf({"x", "y", "z", "intensity"},
                              {1.F + i, 2, 3, 0.5F, -4, 5.25F, 6, 0.125F}),
                      pcl6d::planarPose(i, 2 * i, 0.1 * i));
    out_ = converted({"scans", at("in"), "-o", at("site.e57")});
  }

  std::string
  at(const std::string& name) const
  {
    return (folder_ / name).string();
  }

  TempFolder folder_;
  std::string out_;
};

TEST_F(ConvertE57, AFolderBecomesAFileOfStations)
{
  EXPECT_EQ(
      out_,
      "3 scans, 6 points: pcd to e57\nposes from PCD VIEWPOINT, now in the E57 file\n");
  const pcl6d::E57Source source(at("site.e57"));
  ASSERT_EQ(source.scans().size(), 3U);
  EXPECT_EQ(source.scans()[2].name, "hall2");
  EXPECT_EQ(source.scans()[2].pose->translation(), Eigen::Vector3d(2, 4, 0));
}

TEST_F(ConvertE57, AFileBecomesAFolderAndLosesNothing)
{
  EXPECT_EQ(converted({"scans", at("site.e57"), "-o", at("back"), "--format", "pcd"}),
            "3 scans, 6 points: e57 to pcd\nposes from site.e57, now in VIEWPOINT\n");
  const pcl6d::ScanFolder before(folder_ / "in"), after(folder_ / "back");
  ASSERT_EQ(after.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after.name(i), "scan00" + std::to_string(i) + ".pcd");
    EXPECT_EQ(after.readCloud(i).cloud.data, before.readCloud(i).cloud.data);
    EXPECT_LT((after.initialPose(i).matrix() - before.initialPose(i).matrix()).norm(),
              1e-15);
  }
}

TEST_F(ConvertE57, SelectionsJoinedScansAndSingleOnes)
{
  converted(
      {"scans", at("site.e57"), "-o", at("one.e57"), "--first", "1", "--last", "1"});
  EXPECT_EQ(pcl6d::E57Source(at("one.e57")).scans().at(0).name, "hall1");
  converted({"scans", at("site.e57"), "-o", at("all.ply"), "--full"});
  EXPECT_EQ(pcl6d::readScan(at("all.ply")).points.size(), 6U);
  EXPECT_EQ(
      converted({"scans", at("in/hall1.pcd"), "-o", at("single"), "--format", "e57"}),
      "1 scan, 2 points to e57\n");
  EXPECT_EQ(pcl6d::E57Source(at("single")).scans().at(0).pose->translation(),
            Eigen::Vector3d(1, 2, 0));
}

TEST_F(ConvertE57, WordsThatContradictAreRefused)
{
  expectConvertError({"scans", at("site.e57"), "-o", at("a.e57"), "--format", "pcd"},
                     2,
                     {"--format = pcd, but ", "a.e57 has the extension of e57"});
  expectConvertError({"scans", at("in"), "-o", at("a.pcd"), "--format", "e57"},
                     2,
                     {"--format = e57, but ", "a.pcd has another extension"});
  expectConvertError({"scans", at("in"), "-o", at("a.e57"), "--full"},
                     2,
                     {"--full joins scans, but an E57 file keeps each"});
  expectConvertError({"scans",
                      at("site.e57"),
                      "-o",
                      at("a"),
                      "--format",
                      "ply",
                      "--input-format",
                      "pcd"},
                     2,
                     {"--input-format = pcd, but ", "is a file of several scans"});
  expectConvertError({"scans", at("site.e57"), "-o", at("site.e57")}, 2, {"site.e57"});
  expectConvertError(
      {"scans", at("site.e57"), "-o", at("a")}, 2, {"--format is missing"});
  expectConvertError(
      {"scans", at("in"), "-o", at("a"), "--format", "lasso"}, 2, {"lasso"});
}

} // namespace
