// SPDX-License-Identifier: BSD-3-Clause
// Layouts of KITTI odometry, KITTI raw and KITTI-360: folders, stamps and times of points.
#include "dataset_folder.h"

namespace {
namespace fs = std::filesystem;
using pcl6d::ScanFolder;
using pcl6d::test::DatasetFolder;
using pcl6d::test::expectIoFailed;
using pcl6d::test::fieldNames;
using pcl6d::test::kittiScan;
using pcl6d::test::layoutName;
using pcl6d::test::valuesOf;
using pcl6d::test::writeFile;

class KittiLayouts : public DatasetFolder {
protected:
  /** Writes a sequence of KITTI odometry with poses of reference. */
  void
  writeKitti(const std::string& sequence, int scans = 3) const
  {
    const fs::path path = root() / "sequences" / sequence;
    for (int i = 0; i < scans; ++i)
      writeFile(path / "velodyne" / ("00000" + std::to_string(i) + ".bin"),
                kittiScan());
    writeFile(path / "times.txt", "0\n0.1\n0.2\n");
    writeFile(path / "calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
    writeFile(root() / "poses" / (sequence + ".txt"), "1 0 0 7 0 1 0 0 0 0 1 0\n");
  }

  /** Writes three sweeps of KITTI raw or KITTI-360. */
  static void
  writeRaw(const fs::path& sequence)
  {
    for (int i = 0; i < 3; ++i)
      writeFile(sequence / "velodyne_points/data" /
                    ("000000000" + std::to_string(i) + ".bin"),
                kittiScan());
    writeFile(sequence / "velodyne_points/timestamps.txt",
              "2011-09-26 13:02:25.500000000\n2011-09-26 13:02:25.600000000\n"
              "2011-09-26 13:02:25.700000000\n");
  }
};
} // namespace

TEST_F(KittiLayouts, KittiOdometryIsFoundFromAnyOfItsFolders)
{
  writeKitti("07");
  const fs::path sequence = root() / "sequences/07";
  for (const fs::path& path :
       {root(), root() / "sequences", sequence, sequence / "", sequence / "velodyne"}) {
    SCOPED_TRACE(path.string());
    const ScanFolder scans(path);
    EXPECT_EQ(layoutName(scans), "KITTI odometry");
    ASSERT_EQ(scans.size(), 3u);
    EXPECT_EQ(scans.stamps(), (std::vector<double>{0, 0.1, 0.2}));
    EXPECT_FALSE(scans.hasPoses()); // those of the reference are not taken
    EXPECT_EQ(fieldNames(scans.read(1).cloud), "x y z intensity");
    EXPECT_NE(
        scans.note().find(
            "data set KITTI odometry; points xyzi; x forward, y left, z up [m]; "
            "stamps of times.txt; times of points: none: sweeps are deskewed "
            "already; calibration calib.txt; reference ../../poses/07.txt, not read"),
        std::string::npos)
        << scans.note();
  }
}

TEST_F(KittiLayouts, OfSeveralSequencesOneMustBeNamed)
{
  writeKitti("00");
  writeKitti("03");
  expectIoFailed(
      root(),
      "holds several sequences of scans: sequences/00/velodyne (KITTI odometry), "
      "sequences/03/velodyne (KITTI odometry); give the folder of a single sequence",
      [&] { const ScanFolder scans(root()); });
  EXPECT_EQ(ScanFolder(root() / "sequences/03").size(), 3u);
}

TEST_F(KittiLayouts, StampsOfMissingScansAreLeftOut)
{
  writeKitti("00");
  fs::remove(root() / "sequences/00/velodyne/000001.bin");
  EXPECT_EQ(ScanFolder(root()).stamps(), (std::vector<double>{0, 0.2}));
  writeFile(root() / "sequences/00/times.txt", "0\n");
  expectIoFailed(root() / "sequences/00/times.txt",
                 "1 time stamp, but the folder holds 2 scans",
                 [&] { const ScanFolder scans(root()); });
}

// The scanner turns clockwise and is stamped when it faces forward.
TEST_F(KittiLayouts, KittiRawHasTimesByAzimuthAndStampsByDate)
{
  const fs::path drive = root() / "2011_09_26/2011_09_26_drive_0001_sync";
  writeRaw(drive);
  fs::create_directories(drive / "oxts/data");
  const double first = 1317042145.5; // date -u -d "2011-09-26 13:02:25.5" +%s
  for (const fs::path& path : {root(), drive, drive / "velodyne_points/data"}) {
    SCOPED_TRACE(path.string());
    const ScanFolder scans(path);
    EXPECT_EQ(layoutName(scans), "KITTI raw");
    ASSERT_EQ(scans.stamps().size(), 3u);
    EXPECT_EQ(scans.stamps()[0], first);
    EXPECT_NEAR(scans.stamps()[2], first + 0.2, 1e-6);
    const auto times = valuesOf(scans.read(0).cloud, "time");
    ASSERT_EQ(times.size(), 4u);
    const double period = 0.1, rounding = 1e-6; // of stamps as double
    EXPECT_NEAR(times[0], 0, rounding);
    EXPECT_NEAR(times[1], -period / 4, rounding);
    EXPECT_NEAR(times[2], period / 4, rounding);
    EXPECT_NEAR(times[3], period * 3 / 8, rounding);
  }
}

TEST_F(KittiLayouts, Kitti360IsToldByItsFolder)
{
  const fs::path drive = root() / "data_3d_raw/2013_05_28_drive_0000_sync";
  writeRaw(drive);
  const std::string poses = "data_poses/2013_05_28_drive_0000_sync/poses.txt";
  writeFile(root() / poses, "0 1 0 0 0 0 1 0 0 0 0 1 0\n");
  const ScanFolder scans(root());
  EXPECT_EQ(layoutName(scans), "KITTI-360");
  EXPECT_EQ(scans.layout()->reference,
            (fs::absolute(root()) / poses).lexically_normal());
  EXPECT_FALSE(scans.hasPoses());
  EXPECT_EQ(valuesOf(scans.read(0).cloud, "time").size(), 4u);
}
