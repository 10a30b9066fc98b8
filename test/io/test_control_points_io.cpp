// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"

#include <pcl6d/io/control_points_io.h>

#include <gtest/gtest.h>

using namespace pcl6d::test;
using pcl6d::readControlPoints;
using pcl6d::readScanTargets;

namespace {
const std::vector<std::string> kScans = {"scan000.pcd", "st 2.pcd", "scan007.pcd"};
const std::vector<int> kNumbers = {0, 3, 7};

std::filesystem::path
fileOf(const TempFolder& folder, const std::string& content)
{
  replaceText(folder / "points.csv", content);
  return folder / "points.csv";
}

std::string
refusalOfPoints(const std::string& content)
{
  const TempFolder folder;
  try {
    readControlPoints(fileOf(folder, content));
  } catch (const pcl6d::IoFailed& e) {
    return e.what();
  }
  return "";
}

std::string
refusalOfTargets(const std::string& content)
{
  const TempFolder folder;
  try {
    readScanTargets(fileOf(folder, content), kScans, kNumbers);
  } catch (const pcl6d::IoFailed& e) {
    return e.what();
  }
  return "";
}

void
expectWords(const std::string& message, const std::string& words)
{
  EXPECT_NE(message.find(words), std::string::npos) << message;
}
} // namespace

TEST(ControlPointsIo, ReadsEveryKindOfTable)
{
  const TempFolder folder;
  for (const char* content : {"P 1,3512345.1234,-2.5,7,0.002\nQ,1,2,3\n",
                              "\xef\xbb\xbfname,x,y,z,sigma\r\n\r\n# a remark\r\n"
                              "\"P 1\", 3512345.1234, -2.5, 7, 0.002\r\nQ,1,2,3,\r\n",
                              "Name;E;N;H;s\nP 1;3512345,1234;-2,5;7;0,002\nQ;1;2;3",
                              "P 1\t3512345.1234\t-2.5\t7\t0.002\nQ\t1\t2\t3\n"}) {
    SCOPED_TRACE(content);
    const auto points = readControlPoints(fileOf(folder, content));
    ASSERT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0].name, "P 1");
    EXPECT_EQ(points[0].position, Eigen::Vector3d(3512345.1234, -2.5, 7));
    EXPECT_EQ(points[0].sigma, 0.002);
    EXPECT_EQ(points[1].position, Eigen::Vector3d(1, 2, 3));
    EXPECT_FALSE(points[1].sigma);
  }
  EXPECT_EQ(readControlPoints(fileOf(folder, "P 1 2 3 1e-3")).size(), 1U);
}

TEST(ControlPointsIo, ScansAreNamedByFileStemOrNumber)
{
  const TempFolder folder;
  const auto targets =
      readScanTargets(fileOf(folder,
                             "name,scan,x,y,z\nA,st 2,1,2,3\nA,scan000.pcd,1,2,3\n"
                             "B,7,4,5,6\nB,0,4,5,6\n"),
                      kScans,
                      kNumbers);
  ASSERT_EQ(targets.size(), 4U);
  EXPECT_EQ(targets[0].scan, 1U);
  EXPECT_EQ(targets[1].scan, 0U);
  EXPECT_EQ(targets[2].scan, 2U);
  EXPECT_EQ(targets[3].scan, 0U);
  EXPECT_EQ(targets[2].position, Eigen::Vector3d(4, 5, 6));
}

TEST(ControlPointsIo, RefusesBrokenPointsByLineAndRule)
{
  expectWords(refusalOfPoints(""), "has no points");
  expectWords(refusalOfPoints("name,x,y,z\n"), "has no points");
  expectWords(refusalOfPoints("P,1,2,3\nP,1,2,4\n"), "line 2");
  expectWords(refusalOfPoints("P,1,2,3\nP,1,2,4\n"), "already given in line 1");
  expectWords(refusalOfPoints("P,1,2\n"), "expected name x y z [sigma], got 3 columns");
  expectWords(refusalOfPoints("P,1,2,3,1,9\n"), "got 6 columns");
  expectWords(refusalOfPoints("P,1,2,3\nQ,1,b,3\n"),
              "line 2: expected a finite number");
  expectWords(refusalOfPoints("P,1,nan,3\n"), "expected a finite number");
  expectWords(refusalOfPoints("P,1,2,3,0\n"), "sigma = 0, but must be > 0");
  expectWords(refusalOfPoints(",1,2,3\n"), "the name is empty");
}

TEST(ControlPointsIo, RefusesBrokenTargetsByLineAndRule)
{
  expectWords(refusalOfTargets("A,scan009.pcd,1,2,3\n"),
              "line 1: there is no scan 'scan009.pcd' (scans: scan000.pcd, st 2.pcd");
  expectWords(refusalOfTargets("A,0,1,2,3\nA,scan000,4,5,6\n"), "line 2");
  expectWords(refusalOfTargets("A,0,1,2,3\nA,scan000,4,5,6\n"),
              "already given in line 1");
  expectWords(refusalOfTargets("A,0,1,2\n"), "expected name scan x y z, got 4 columns");
  expectWords(refusalOfTargets("A,0,1,2,inf\n"), "expected a finite number");
}
