// SPDX-License-Identifier: BSD-3-Clause
// Folders and E57 files through one door, and a run's selection from them.
#include "sources/made_e57.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/folder_source.h>
#include <pcl6d/sources/open_source.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl6d::test;
using pcl6d::openScanFolder;
using pcl6d::openSource;
using pcl6d::ScanFolderOptions;

MadeScan
stationAt(double x, const std::string& name)
{
  MadeScan scan = scanOfPoints({{1, 0, 0}, {0, 0, 0}, {0, 2, 0}, {0, 0, x + 3}});
  scan.about = "<name type=\"String\">" + name +
               "</name><pose type=\"Structure\"><translation type=\"Structure\"><x "
               "type=\"Float\">" +
               std::to_string(x) + "</x></translation></pose>";
  return scan;
}

class OpenSource : public testing::Test {
protected:
  OpenSource()
  {
    makeE57(site_, {stationAt(0, "a"), stationAt(1, "b"), stationAt(2, "c")});
  }
  TempFolder folder_;
  const std::filesystem::path site_ = folder_ / "Site.E57";
};

TEST_F(OpenSource, ARunSelectsFromAnE57FileAsFromAFolder)
{
  ScanFolderOptions options;
  options.first = 1;
  const pcl6d::ScanFolder scans = openScanFolder(site_, options);
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans.name(0), "b");
  EXPECT_EQ(scans.index(1), 2);
  EXPECT_EQ(scans.title(1), site_.string() + ": scan 2 (c)");
  EXPECT_EQ(scans.file(1), site_);
  EXPECT_TRUE(scans.sharesFile(1));
  EXPECT_EQ(scans.initialPose(1).translation(), Eigen::Vector3d(2, 0, 0));
  EXPECT_TRUE(scans.hasPoses());
  EXPECT_EQ(scans.poseSource(), "Site.E57");
  EXPECT_EQ(scans.formatName(), "e57");
  for (int round = 0; round < 2; ++round) { // the first is kept from opening
    const pcl6d::Scan scan = scans.read(0);
    EXPECT_EQ(scan.points.size(), 3U);
    EXPECT_EQ(scan.dropped, 1U); // at (0, 0, 0)
    EXPECT_EQ(scan.points[2], Eigen::Vector3f(0, 0, 4));
  }
}

TEST_F(OpenSource, AFileOfPosesTakesTheirPlace)
{
  writeText(
      folder_ / "poses.txt",
      "1 0 0 7 0 1 0 0 0 0 1 0\n1 0 0 8 0 1 0 0 0 0 1 0\n1 0 0 9 0 1 0 0 0 0 1 0\n");
  ScanFolderOptions options;
  options.poses_file = folder_ / "poses.txt";
  EXPECT_EQ(openScanFolder(site_, options).initialPose(2).translation().x(), 9);
  writeText(options.poses_file, "1 0 0 7 0 1 0 0 0 0 1 0\n");
  try {
    openScanFolder(site_, options);
    FAIL() << "one pose for three scans";
  } catch (const pcl6d::IoFailed& e) {
    EXPECT_EQ(e.what(),
              options.poses_file.string() + ": 1 pose, but " + site_.string() +
                  " holds 3 scans: no pose for b");
  }
}

TEST_F(OpenSource, PosesThatAreAllTheIdentityAreNone)
{
  makeE57(site_, {stationAt(0, "a"), stationAt(0, "b")});
  EXPECT_FALSE(openScanFolder(site_).hasPoses());
}

TEST_F(OpenSource, FarPointsAreBroughtNearInTheWorldOfTheirPoses)
{
  // Stations 2 m apart around national coordinates, points in their world.
  const Eigen::Vector3d world(512345, 5403210, 400);
  std::vector<MadeScan> stations;
  for (int s = 0; s < 2; ++s) {
    std::vector<std::vector<double>> points;
    for (int i = 0; i < 8; ++i)
      points.push_back({world.x() + 2 * s + (i & 1 ? 5.25 : -5.25),
                        world.y() + (i & 2 ? 5.25 : -5.25),
                        world.z() + (i & 4 ? 5.25 : -5.25)});
    stations.push_back(scanOfPoints(points));
  }
  makeE57(site_, stations);
  const pcl6d::ScanFolder scans = openScanFolder(site_);
  ASSERT_TRUE(scans.moved());
  const pcl6d::Scan scan = scans.read(1);
  EXPECT_LT(scan.points[0].norm(), 20);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR((scans.initialPose(1) * scan.points[0].cast<double>())[axis],
                stations[1].fields[static_cast<std::size_t>(axis)].reals[0],
                1e-9);
}

TEST_F(OpenSource, WhatIsNoFolderAndNoE57IsRefused)
{
  EXPECT_THROW(openSource(folder_ / "missing.e57"), pcl6d::IoFailed);
  EXPECT_THROW(openSource(folder_ / "missing"), pcl6d::IoFailed);
  ScanFolderOptions options;
  options.format = pcl6d::ScanFormat::kPcd;
  EXPECT_THROW(openScanFolder(site_, options), pcl6d::BadArgument);
  options = {};
  options.first = 3;
  EXPECT_THROW(openScanFolder(site_, options), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::ScanFolder(std::shared_ptr<const pcl6d::ScanSource>()),
               pcl6d::BadArgument);
}

TEST_F(OpenSource, AFolderIsASourceAndMayHaveAnyName)
{
  const auto path = folder_ / "folder.e57";
  std::filesystem::create_directory(path);
  const pcl6d::ScanFolder scans = openScanFolder(site_);
  for (const char* const name : {"scan10.pcd", "scan9.pcd"})
    pcl6d::writePcd(path / name, scans.readCloud(0).cloud, scans.initialPose(1));
  const auto source = openSource(path);
  ASSERT_EQ(source->scans().size(), 2U);
  EXPECT_EQ(source->scans()[0].name, "scan9.pcd");
  EXPECT_EQ(source->scans()[0].pose->translation(), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(source->format(), "pcd");
  EXPECT_EQ(source->path(), path);
  EXPECT_EQ(source->read(1).cloud.width, 3U);
  EXPECT_THROW(source->read(2), pcl6d::BadArgument);
  EXPECT_EQ(openScanFolder(path).size(), 2U);
}

} // namespace
