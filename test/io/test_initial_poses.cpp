// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_folder.h>

namespace fs = std::filesystem;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

constexpr int kScans = 3;

std::string
scanName(int i)
{
  return "scan00" + std::to_string(i);
}

/** \return a KITTI row at position x [m] */
std::string
kittiRow(double x)
{
  return "1 0 0 " + std::to_string(x) + " 0 1 0 0 0 0 1 0\n";
}

/** \brief A folder of three scans. Each source of poses says another x position, so
 * that one sees which was taken: scan i stands at x = source + i. */
class InitialPoses : public testing::Test {
protected:
  void
  SetUp() override
  {
    addScans(0);
  }

  /** Writes the scans with this VIEWPOINT. */
  void
  addScans(double x) const
  {
    for (int i = 0; i < kScans; ++i)
      pcl6d::writePcd(folder_ / (scanName(i) + ".pcd"),
                      pcl6d::test::makeRichCloud(3),
                      pcl6d::planarPose(x == 0 ? 0 : x + i, 0, 0));
  }
  void
  addRows(const std::string& name, double x, int count = kScans) const
  {
    std::string rows;
    for (int i = 0; i < count; ++i)
      rows += kittiRow(x + i);
    writeText(folder_ / name, rows);
  }
  void
  addScanPoses(double x) const
  {
    for (int i = 0; i < kScans; ++i) // forward is the third number, in cm
      writeText(folder_ / (scanName(i) + ".pose"),
                "0 0 " + std::to_string(100 * (x + i)) + "\n0 0 0\n");
  }
  ScanFolder
  open(const fs::path& poses_file = {}) const
  {
    ScanFolderOptions options;
    options.poses_file = poses_file;
    return ScanFolder(folder_.path(), options);
  }
  void
  expectSource(const std::string& source,
               double x,
               const fs::path& poses_file = {}) const
  {
    const ScanFolder scans = open(poses_file);
    EXPECT_EQ(scans.poseSource(), source);
    for (std::size_t i = 0; i < scans.size(); ++i)
      EXPECT_NEAR(scans.initialPose(i).translation().x(),
                  source == "identity" ? 0 : x + static_cast<double>(i),
                  1e-12);
  }

  const TempFolder folder_;
};

} // namespace

TEST_F(InitialPoses, EachSourceComesBeforeTheNext)
{
  expectSource("identity", 0);
  addScans(10);
  expectSource("PCD VIEWPOINT", 10);
  addRows("poses.txt", 20);
  expectSource("poses.txt", 20);
  addRows("odometry.txt", 30);
  expectSource("odometry.txt", 30);
  addScanPoses(40);
  expectSource("scan poses (*.pose)", 40);
  addRows("given.txt", 50);
  expectSource("scan poses (*.pose)", 40); // not unless it is given
  const fs::path given = folder_ / "given.txt";
  expectSource(given.string(), 50, given);
}

TEST_F(InitialPoses, TheGroundTruthIsReadOnlyWhenItIsNamed)
{
  addRows("odometry.txt", 30);
  writeText(folder_ / "groundtruth.txt", "wrong\n");
  writeText(folder_ / "groundtruth.pcd", "wrong\n");
  writeText(folder_ / "groundtruth.ply", "wrong\n");
  expectSource("odometry.txt", 30);
  fs::remove(folder_ / "odometry.txt");
  expectSource("identity", 0);
  addRows("groundtruth.txt", 60);
  const fs::path truth = folder_ / "groundtruth.txt";
  expectSource(truth.string(), 60, truth);
}

TEST_F(InitialPoses, PosesOfKittisCameraAreTakenToTheLidar)
{
  // The camera looks along z, its x is right and its y down; it stands 0.3 m ahead.
  writeText(folder_ / "calib.txt",
            "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  std::string rows;
  for (int i = 0; i < kScans; ++i)
    rows += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(2 * i) + "\n";
  writeText(folder_ / "poses.txt", rows);
  const ScanFolder scans = open();
  EXPECT_EQ(scans.poseSource(), "poses.txt (of the camera, by calib.txt)");
  EXPECT_TRUE(scans.initialPose(2).isApprox(pcl6d::planarPose(4, 0, 0), 1e-12));
  addRows("poses.txt", 0); // moves along x: these are the lidar's
  EXPECT_EQ(open().poseSource(), "poses.txt");
  writeText(folder_ / "poses.txt", rows);
  writeText(folder_ / "calib.txt", "Tr: 0 -1 0 0\n");
  expectIoFailed(folder_ / "calib.txt",
                 "line 1: expected 12 numbers behind Tr:, got 4",
                 [&] { open(); });
  writeText(folder_ / "calib.txt", "P0: 1 0 0\n");
  EXPECT_EQ(open().poseSource(), "poses.txt");
}

TEST_F(InitialPoses, AFolderOfAUsualNameIsEnteredAndThatIsSaid)
{
  for (const std::string name :
       {"velodyne", "lidar", "scans", "velodyne_points/data"}) {
    const TempFolder outer;
    fs::create_directories(outer / name);
    for (int i = 0; i < kScans; ++i)
      fs::copy(folder_ / (scanName(i) + ".pcd"), outer / name);
    writeText(outer / "poses.txt", kittiRow(5) + kittiRow(6) + kittiRow(7));
    writeText(outer / "times.txt", "0.5\n1\n2\n");
    const ScanFolder scans(outer.path());
    EXPECT_EQ(scans.size(), 3U);
    EXPECT_EQ(scans.note(), "scans are those in " + (outer / name).string());
    EXPECT_EQ(scans.poseSource(), "poses.txt");
    EXPECT_EQ(scans.initialPose(0).translation().x(), 5);
    EXPECT_EQ(scans.stamps().front(), 0.5);
    writeText(outer / name / "odometry.txt", kittiRow(1) + kittiRow(2) + kittiRow(3));
    EXPECT_EQ(ScanFolder(outer.path()).initialPose(0).translation().x(), 1);
    fs::copy(folder_ / "scan000.pcd", outer.path()); // now it has one of its own
    EXPECT_THROW(ScanFolder(outer.path()), pcl6d::IoFailed); // with three poses
    fs::remove(outer / "poses.txt");
    fs::remove(outer / "times.txt");
    EXPECT_EQ(ScanFolder(outer.path()).size(), 1U);
    EXPECT_EQ(ScanFolder(outer.path()).note(), "");
  }
  const TempFolder outer;
  for (const char* const name : {"velodyne", "lidar"}) {
    fs::create_directory(outer / name);
    fs::copy(folder_ / "scan000.pcd", outer / name);
  }
  expectIoFailed(outer.path(),
                 "holds scans in velodyne and in lidar; choose one of them",
                 [&] { const ScanFolder scans(outer.path()); });
}

TEST_F(InitialPoses, OneViewpointThatDiffersFromIdentityMakesAllCount)
{
  pcl6d::writePcd(folder_ / "scan001.pcd",
                  pcl6d::test::makeRichCloud(3),
                  pcl6d::planarPose(0, 1e-9, 0));
  const ScanFolder scans = open();
  EXPECT_EQ(scans.poseSource(), "PCD VIEWPOINT");
  EXPECT_EQ(scans.initialPose(0).translation().y(), 0);
  EXPECT_EQ(scans.initialPose(1).translation().y(), 1e-9);
}

TEST_F(InitialPoses, EveryScanOfTheFolderNeedsAPoseAndEveryPoseAScan)
{
  addRows("odometry.txt", 30, kScans - 1);
  const auto path = folder_ / "odometry.txt";
  expectIoFailed(path,
                 "2 poses, but the folder holds 3 scans: no pose for scan002.pcd",
                 [&] { open(); });
  addRows("odometry.txt", 30, kScans + 1);
  expectIoFailed(path, "4 poses, but the folder holds 3 scans", [&] { open(); });
  ScanFolderOptions options;
  options.last = 0; // scans that are left out count all the same
  expectIoFailed(path, "4 poses, but the folder holds 3 scans", [&] {
    ScanFolder(folder_.path(), options);
  });
}

TEST_F(InitialPoses, AMissingPoseFileOfAScanIsNamed)
{
  addScanPoses(40);
  const auto path = folder_ / "scan001.pose";
  fs::remove(path);
  expectIoFailed(
      path,
      "missing, although further scans have a .pose file: no pose for scan001.pcd",
      [&] { open(); });
}

TEST_F(InitialPoses, BrokenSourcesAreNamedAndNotSkipped)
{
  addRows("poses.txt", 20);
  writeText(folder_ / "odometry.txt",
            kittiRow(1) + kittiRow(2) + "2 0 0 0 0 1 0 0 0 0 1 0\n");
  expectIoFailed(folder_ / "odometry.txt",
                 "line 3: not a rigid motion (largest entry of |R^T R - I| is 3)",
                 [&] { open(); });
  expectIoFailed(folder_ / "missing.txt", "No such file or directory", [&] {
    open(folder_ / "missing.txt");
  });
  fs::remove(folder_ / "odometry.txt");
  fs::create_directory(folder_ / "odometry.txt");
  expectIoFailed(folder_ / "odometry.txt", "Is a directory", [&] { open(); });
}

TEST_F(InitialPoses, ABrokenViewpointIsAnError)
{
  const auto path = folder_ / "scan001.pcd";
  std::string content = pcl6d::test::readText(path);
  content.replace(content.find("VIEWPOINT 0 0 0 1"), 17, "VIEWPOINT 0 0 1 0");
  writeText(path, content);
  expectIoFailed(
      path,
      "line 9: not a rigid motion (the quaternion has norm 0, but must have 1)",
      [&] { open(); });
  addRows("odometry.txt", 30); // then nobody looks at it
  expectSource("odometry.txt", 30);
}

TEST_F(InitialPoses, StampsAreThoseOfTheSelectedScans)
{
  EXPECT_TRUE(open().stamps().empty());
  writeText(folder_ / "given.tum",
            "100.5 30 0 0 0 0 0 1\n101.5 31 0 0 0 0 0 1\n102.5 32 0 0 0 0 0 1\n");
  ScanFolderOptions options;
  options.poses_file = folder_ / "given.tum";
  options.every = 2;
  const ScanFolder scans(folder_.path(), options);
  EXPECT_EQ(scans.stamps(), (std::vector<double>{100.5, 102.5}));
  EXPECT_EQ(scans.initialPose(1).translation().x(), 32);
}

TEST_F(InitialPoses, StampsComeWithThePosesOrFromTheirOwnFile)
{
  addRows("odometry.txt", 30);
  EXPECT_TRUE(open().stamps().empty());
  writeText(folder_ / "times.txt", "# seconds\n0.5\n1.25\n\n3\n");
  EXPECT_EQ(open().stamps(), (std::vector<double>{0.5, 1.25, 3}));
  ScanFolderOptions second;
  second.first = 1;
  second.every = 2;
  const ScanFolder selected(folder_.path(), second);
  EXPECT_EQ(selected.stamps(), (std::vector<double>{1.25}));
  EXPECT_EQ(selected.odometry().stamps, (std::vector<double>{0.5, 1.25, 3}));
  ASSERT_EQ(selected.odometry().poses.size(), 3u);
  EXPECT_EQ(selected.odometry().poses[2].translation().x(), 32);
  const fs::path tum = folder_ / "given.tum";
  writeText(tum, "7 1 0 0 0 0 0 1\n8 2 0 0 0 0 0 1\n9 3 0 0 0 0 0 1\n");
  EXPECT_EQ(open(tum).stamps(), (std::vector<double>{7, 8, 9}));
}

TEST_F(InitialPoses, BrokenStampsAreRefused)
{
  const auto path = folder_ / "times.txt";
  const auto expectMessage = [&](const std::string& content,
                                 const std::string& message) {
    writeText(path, content);
    expectIoFailed(path, message, [&] { open(); });
  };
  expectMessage("1\n2\n", "2 time stamps, but the folder holds 3 scans");
  expectMessage("\n", "holds no time stamp");
  expectMessage("1\n2 3\n4\n", "line 2: expected 1 number (a time stamp), got 2");
  expectMessage("1\n2\n2\n",
                "line 3: the stamp 2 does not follow 2; stamps must increase");
  expectMessage("1\nnan\n3\n", "line 2: the stamp nan is not finite");
  expectMessage("1\ntwo\n3\n", "line 2: 'two' is not a number");
}

TEST(FindScanPose, TakesThePoseFileThenTheViewpoint)
{
  const TempFolder folder;
  const auto cloud = pcl6d::test::makeRichCloud(1);
  const Eigen::Isometry3d pose(Eigen::Translation3d(1, 2, 3));
  pcl6d::writePcd(folder / "a.pcd", cloud);
  writeText(folder / "a.xyz", "1 2 3\n");
  EXPECT_FALSE(pcl6d::findScanPose(folder / "a.pcd"));
  EXPECT_FALSE(pcl6d::findScanPose(folder / "a.xyz"));
  pcl6d::writePcd(folder / "a.pcd", cloud, pose);
  ASSERT_TRUE(pcl6d::findScanPose(folder / "a.pcd"));
  EXPECT_EQ(pcl6d::findScanPose(folder / "a.pcd")->matrix(), pose.matrix());
  EXPECT_FALSE(pcl6d::findScanPose(folder / "a.xyz"));
  writeText(folder / "a.pose", "0 0 100\n0 0 0\n");
  for (const char* const name : {"a.pcd", "a.xyz"}) {
    ASSERT_TRUE(pcl6d::findScanPose(folder / name));
    EXPECT_EQ(pcl6d::findScanPose(folder / name)->translation(),
              Eigen::Vector3d(1, 0, 0));
  }
}
