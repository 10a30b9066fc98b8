// SPDX-License-Identifier: BSD-3-Clause
// Folders of scans whose points lie far from the origin of their coordinates.
#include "far_samples.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
/** \brief A folder of three scans of one room. */
class FarFolder : public testing::Test {
protected:
  /** Poses of the scanner that turns a good deal, near the origin. */
  static std::vector<Eigen::Isometry3d>
  poses()
  {
    return {
        planarPose(0.5, -0.25, 0), planarPose(1, 0.5, 1.2), planarPose(1.5, 0, -0.8)};
  }

  void
  write(const std::vector<Places>& scans, const std::vector<Eigen::Isometry3d>& poses)
  {
    for (std::size_t i = 0; i < scans.size(); ++i)
      writeText(folder_ / ("scan" + std::to_string(i) + ".xyz"), rowsOf(scans[i]));
    if (!poses.empty())
      writeTrajectoryKitti(folder_ / "odometry.txt", {poses, {}});
  }

  /** Expects that near points at their poses are where the world has them. */
  static void
  expectWorld(const ScanFolder& folder, const std::vector<Places>& world)
  {
    for (std::size_t i = 0; i < folder.size(); ++i) {
      const Points points = folder.read(i).points;
      Places placed;
      for (const auto& p : points) {
        EXPECT_LT(p.norm(), 20); // near, or float would lose digits
        placed.push_back(folder.initialPose(i) * p.cast<double>());
      }
      ASSERT_EQ(placed.size(), world[i].size());
      for (std::size_t k = 0; k < placed.size(); ++k)
        EXPECT_LT((placed[k] - world[i][k]).norm(), 2e-6);
    }
  }

  const TempFolder folder_;
};
} // namespace

TEST_F(FarFolder, PointsInTheWorldWithoutPosesAreMoved)
{
  const std::vector<Places> world = {moved(room(1), kUtm), moved(room(2), kUtm)};
  write(world, {});
  const ScanFolder folder(folder_.path());
  ASSERT_TRUE(folder.moved());
  EXPECT_EQ(folder.moved()->reading, PoseReading::kFile);
  EXPECT_LT((folder.moved()->offset - kUtm).norm(), 2);
  EXPECT_FALSE(folder.hasPoses());
  expectWorld(folder, world);
  EXPECT_NE(folder.coordinates().find("points lie 5427.4 km from the origin of their "
                                      "coordinates: moved by (-51234"),
            std::string::npos)
      << folder.coordinates();
  EXPECT_TRUE(folder.poseOfFile(1).matrix().isIdentity(1e-9));
}

TEST_F(FarFolder, PosesThatBelongToTheFilesPointsKeepTheirMeaning)
{
  for (const Eigen::Vector3d& offset : {kUtm, Eigen::Vector3d(1000, 0, 0)}) {
    std::vector<Places> scans, world;
    std::vector<Eigen::Isometry3d> given;
    for (std::size_t i = 0; i < 3; ++i) {
      const Places seen = room(static_cast<unsigned int>(i));
      scans.push_back(moved(seen, offset));
      world.push_back(moved(seen, poses()[i]));
      given.push_back(poses()[i] * Eigen::Translation3d(-offset));
    }
    write(scans, given);
    const ScanFolder folder(folder_.path());
    ASSERT_TRUE(folder.moved());
    EXPECT_EQ(folder.moved()->reading, PoseReading::kFile);
    expectWorld(folder, world);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(
          folder.moved()->asGiven(folder.initialPose(i)).isApprox(given[i], 1e-9));
  }
}

TEST_F(FarFolder, AnOffsetThatThePosesDoNotHoldIsTakenOff)
{
  for (const Eigen::Vector3d& offset : {kUtm, Eigen::Vector3d(0, -1000, 0)}) {
    std::vector<Places> scans, world;
    for (std::size_t i = 0; i < 3; ++i) {
      const Places seen = room(static_cast<unsigned int>(i));
      scans.push_back(moved(seen, offset));
      world.push_back(moved(seen, poses()[i]));
    }
    write(scans, poses());
    const ScanFolder folder(folder_.path());
    ASSERT_TRUE(folder.moved());
    EXPECT_EQ(folder.moved()->reading, PoseReading::kScanner);
    const Eigen::Vector3d rest = folder.moved()->offset - offset; // whole metres
    EXPECT_LT(rest.norm(), 2.5);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(folder.initialPose(i).matrix(), folder.odometry().poses[i].matrix());
      const Places near = moved(room(static_cast<unsigned int>(i)), -rest);
      EXPECT_LT(distanceOf(folder.read(i).points, near), 1e-6);
    }
    EXPECT_NE(
        folder.coordinates().find(" m, which the poses (odometry.txt) do not hold;"),
        std::string::npos);
  }
}

TEST_F(FarFolder, PointsInTheWorldOfTheirStationsAreTakenBack)
{
  std::vector<Places> scans;
  std::vector<Eigen::Isometry3d> stations;
  for (std::size_t i = 0; i < 3; ++i) {
    stations.push_back(Eigen::Translation3d(kUtm) * poses()[i]);
    scans.push_back(moved(room(static_cast<unsigned int>(i)), stations[i]));
  }
  write(scans, stations);
  const ScanFolder folder(folder_.path());
  ASSERT_TRUE(folder.moved());
  EXPECT_EQ(folder.moved()->reading, PoseReading::kStation);
  EXPECT_TRUE(folder.moved()->offset.isZero(0));
  expectWorld(folder, scans);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(distanceOf(folder.read(i).points, room(static_cast<unsigned int>(i))),
              1e-6);
    EXPECT_TRUE(folder.poseOfFile(i).matrix().isIdentity(1e-6));
  }
}

TEST_F(FarFolder, PointsStayWhereTheyAreIfAsked)
{
  const std::vector<Places> world = {moved(room(1), kUtm), moved(room(2), kUtm)};
  write(world, {});
  ScanFolderOptions options;
  options.keep_coordinates = true;
  const ScanFolder folder(folder_.path(), options);
  EXPECT_FALSE(folder.moved());
  EXPECT_TRUE(folder.coordinates().empty());
  EXPECT_LT(distanceOf(folder.readCloud(1).cloud, world[1]), 1e-8);
}

TEST_F(FarFolder, NearScansAreNotTouched)
{
  write({room(1), room(2), room(3)}, poses());
  const ScanFolder folder(folder_.path());
  EXPECT_FALSE(folder.moved());
  for (int repeat = 0; repeat < 2; ++repeat) // the first one was read already, once
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(
          distanceOf(folder.read(i).points, room(static_cast<unsigned int>(i + 1))), 0);
  const ScanFolder copy = folder;
  EXPECT_EQ(copy.read(0).points, folder.read(0).points);
}

TEST_F(FarFolder, WhatWasNotMeasuredIsDroppedAndRowsKeepTheirPlaces)
{
  Places places = moved(room(), kUtm);
  for (std::size_t i = 0; i < places.size(); i += 3)
    places[i].setZero();
  const std::string n = std::to_string(places.size() / 3);
  std::string header = pcdHeader(places.size(), 8, "binary");
  const std::string one_row = "WIDTH " + std::to_string(places.size()) + "\nHEIGHT 1\n";
  header.replace(header.find(one_row), one_row.size(), "WIDTH " + n + "\nHEIGHT 3\n");
  writeText(folder_ / "scan.pcd", header + binaryOf<double>(places));
  const ScanFolder folder(folder_.path());
  ASSERT_TRUE(folder.moved());
  const ScanCloud scan = folder.readCloud(0);
  EXPECT_EQ(scan.dropped, places.size() / 3);
  EXPECT_EQ(scan.row_length, places.size() / 3);
  ASSERT_EQ(scan.places.size(), 2 * places.size() / 3);
  EXPECT_EQ(scan.places[0], 1U);
  EXPECT_EQ(scan.places[2], 4U);
}

TEST_F(FarFolder, ABrokenFirstScanIsToldWhenItIsRead)
{
  writeText(folder_ / "scan0.xyz", "1 2\n");
  const ScanFolder folder(folder_.path());
  expectIoFailed(folder_ / "scan0.xyz",
                 "line 1: expected at least 3 numbers, got 2",
                 [&] { folder.read(0); });
}
