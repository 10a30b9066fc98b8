// SPDX-License-Identifier: BSD-3-Clause
// PTX: headers, grids, missing returns, several scans in a file, and the way back.
#include "io_test.h"
#include "scan_samples.h"

#include <pcl6d/io/ptx_io.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_writer.h>

#include <cmath>

using pcl6d::listPtxScans;
using pcl6d::readPtxScan;
using pcl6d::ScanFormat;
using pcl6d::test::expectIoFailed;
using pcl6d::test::replaceText;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;

namespace {

const std::string kUnit = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string kAtOrigin = kUnit + "0 0 0 1\n";
// A quarter of a turn to the left: the image of x is y, which is the first row of PTX.
const std::string kTurned =
    "4 5 6\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n4 5 6 1\n";

class Ptx : public testing::Test {
protected:
  std::vector<pcl6d::PtxScan>
  list(const std::string& content)
  {
    replaceText(file_, content);
    return listPtxScans(file_);
  }

  pcl6d::ScanCloud
  read(const std::string& content, std::size_t i = 0)
  {
    const auto scans = list(content);
    return readPtxScan(file_, scans.at(i));
  }

  void
  expectRefused(const std::string& content, const std::string& message)
  {
    expectIoFailed(file_, message, [&] {
      for (const auto& scan : list(content))
        readPtxScan(file_, scan);
    });
  }

  TempFolder folder_;
  const std::filesystem::path file_ = folder_ / "site.ptx";
};
} // namespace

TEST_F(Ptx, AScanIsAGridWithColumnsAsLines)
{
  const auto scan =
      read("2\n3\n" + kAtOrigin +
           "1 0 0 0.1\n1 0 1 0.2\n1 0 2 0.3\n0 1 0 0.4\n0 1 1 0.5\n0 1 2 0.6\n");
  EXPECT_EQ(scan.cloud.width, 3U);  // rows of the grid
  EXPECT_EQ(scan.cloud.height, 2U); // columns
  EXPECT_EQ(valueOf<float>(scan.cloud, 2, "z"), 2);
  EXPECT_EQ(valueOf<float>(scan.cloud, 3, "y"), 1);
  EXPECT_EQ(valueOf<float>(scan.cloud, 5, "intensity"), 0.6f);
}

TEST_F(Ptx, TheMatrixIsThePoseByColumns)
{
  const auto scans = list("1\n1\n" + kTurned + "1 0 0 0.5\n");
  const Eigen::Isometry3d& pose = scans.at(0).T_world_scan;
  EXPECT_TRUE((pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(4, 6, 6)));
  EXPECT_TRUE((pose * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(3, 5, 6)));
}

TEST_F(Ptx, SeveralScansFollowEachOther)
{
  const std::string content = "1\n2\n" + kAtOrigin + "1 0 0 0.5\n2 0 0 0.5\n\n1\n1\n" +
                              kTurned + "7 8 9 0.25 255 128 1\n";
  const auto scans = list(content);
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[1].line, 24U);
  const auto second = readPtxScan(file_, scans[1]);
  EXPECT_EQ(valueOf<float>(second.cloud, 0, "x"), 7);
  EXPECT_EQ(valueOf<std::uint32_t>(second.cloud, 0, "rgb"), 0xff8001U);
  EXPECT_EQ(readPtxScan(file_, scans[0]).cloud.fields.size(), 4U); // no colours there
  expectIoFailed(
      file_,
      "holds 2 scans, but a single scan is needed; give the file in place of a folder",
      [&] { pcl6d::readScan(file_); });
}

TEST_F(Ptx, RowsOfZerosAreMissingReturns)
{
  const std::string rows = "0 0 0 0.5\n0 0 0\n1 2 3 0.5 9 8 7\n0 0 0 0.500000 0 0 0\n";
  const auto scan = read("2\n2\n" + kAtOrigin + rows);
  ASSERT_EQ(scan.cloud.data.size(), 4 * scan.cloud.point_step);
  for (const std::size_t i : {0, 1, 3})
    EXPECT_TRUE(std::isnan(valueOf<float>(scan.cloud, i, "x")));
  EXPECT_EQ(valueOf<float>(scan.cloud, 2, "y"), 2);
  EXPECT_EQ(valueOf<std::uint32_t>(scan.cloud, 2, "rgb"), 0x090807U);
  const auto finite = pcl6d::readScan(file_);
  EXPECT_EQ(finite.dropped, 3U);
  EXPECT_EQ(finite.row_length, 2U);
  EXPECT_EQ(finite.places, (std::vector<std::uint32_t>{2}));
}

TEST_F(Ptx, FarCoordinatesAreReadInDouble)
{
  const auto scan =
      read("1\n2\n" + kAtOrigin +
           "637012.24 849028.31 431.66 0.5\n637012.25 849028.31 431 0.5\n");
  EXPECT_EQ(valueOf<double>(scan.cloud, 0, "x"), 637012.24);
}

TEST_F(Ptx, BrokenHeadersAreNamed)
{
  expectRefused("", "holds no scan");
  expectRefused(
      "a\n", "line 1: 'a' is not the number of columns at the beginning of a PTX scan");
  expectRefused(
      "1\n-1\n",
      "line 2: '-1' is not the number of rows at the beginning of a PTX scan");
  expectRefused("1\n1\n0 0\n", "line 3: expected 3 numbers of the header, got 2");
  expectRefused("1\n1\n0 0 0\n1 0 x\n", "line 4: 'x' is not a number");
  expectRefused("1\n1\n0 0 0\n", "ends in the header of a scan, behind line 3");
  expectRefused(
      "1\n1\n" + kUnit + "0 0 0 2\n1 1 1\n",
      "line 7: not a rigid motion (the last column of the matrix is not 0 0 0 1)");
  expectRefused(
      "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 2\n1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n1 1 1\n",
      "line 7: not a rigid motion (largest entry of |R^T R - I| is 3)");
}

TEST_F(Ptx, RowsThatAreMissingOrWrongAreNamed)
{
  const std::string head = "2\n2\n" + kAtOrigin;
  expectRefused(head + "1 2 3 0.5\n", "ends after 1 of 2 x 2 points of scan 0");
  expectRefused("4000000000\n4000000000\n" + kAtOrigin,
                "ends after 0 of 4000000000 x 4000000000 points of scan 0");
  const std::string three = "1 2 3 0.5\n1 2 3 0.5\n1 2 3 0.5\n";
  expectRefused(head + three + "1 2 x 0.5\n", "line 14: 'x' is not a number");
  expectRefused(head + three + "1 2 3\n",
                "line 14: expected 3, 4 or 7 numbers, the count of the first row of "
                "the scan, got 3");
  expectRefused(head + three + "1 2 3 4 5\n",
                "line 14: expected 3, 4 or 7 numbers, the count of the first row of "
                "the scan, got 5");
  expectRefused(head + three + "1 2 3 4 5 6 7 8\n",
                "line 14: expected at most 7 numbers (x y z intensity r g b)");
  expectRefused(head + three + "1 2 3 0.5\n1 2 3 0.5\n",
                "line 15: '1 2 3 0.5' is not the number of columns at the beginning of "
                "a PTX scan");
}

TEST_F(Ptx, AScanComesBackAsItWasWritten)
{
  auto cloud = pcl6d::test::randomCloud(12, true);
  cloud.width = 4;
  cloud.height = 3;
  cloud.is_dense = false;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  pose.translation() << 10, -20, 30.5;
  EXPECT_TRUE(pcl6d::writeScan(file_, cloud, pose).empty());
  const auto scans = listPtxScans(file_);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].columns, 3U);
  EXPECT_TRUE(scans[0].T_world_scan.isApprox(pose, 1e-15));
  EXPECT_TRUE(pcl6d::findScanPose(file_)->isApprox(pose, 1e-15));
  const auto back = readPtxScan(file_, scans[0]);
  for (std::size_t i = 0; i < 12; ++i) {
    bool is_finite = true;
    for (const char* const name : {"x", "y", "z"})
      is_finite = is_finite && std::isfinite(valueOf<float>(cloud, i, name));
    for (const char* const name : {"x", "y", "z"}) {
      if (is_finite)
        EXPECT_EQ(valueOf<float>(back.cloud, i, name), valueOf<float>(cloud, i, name));
      else
        EXPECT_TRUE(std::isnan(valueOf<float>(back.cloud, i, name)));
    }
  }
}

TEST_F(Ptx, AFolderHasThePosesOfItsHeaders)
{
  replaceText(folder_ / "a.ptx", "1\n1\n" + kAtOrigin + "1 0 0 0.5\n");
  replaceText(folder_ / "b.ptx", "1\n1\n" + kTurned + "1 0 0 0.5\n");
  const pcl6d::ScanFolder scans(folder_.path());
  EXPECT_EQ(scans.poseSource(), "headers of PTX");
  EXPECT_EQ(scans.initialPose(1).translation(), Eigen::Vector3d(4, 5, 6));
}
