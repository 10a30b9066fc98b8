// SPDX-License-Identifier: BSD-3-Clause
// Poses that do not tell where the scans are, and stamps of poses against stamps in names.
#include "pcd_samples.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_folder.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** \brief Four scans named by their time: 1657900000.5 s and the three seconds after it. */
class PosesOfScans : public testing::Test {
protected:
  PosesOfScans()
  {
    for (int i = 0; i < 4; ++i)
      add(nameOf(i));
  }

  static std::string
  nameOf(int i)
  {
    return std::to_string(1657900000 + i) + ".5.pcd";
  }

  void
  add(const std::string& name,
      const Eigen::Isometry3d& viewpoint = Eigen::Isometry3d::Identity()) const
  {
    pcl6d::writePcd(folder_ / name, pcl6d::test::makeRichCloud(3), viewpoint);
  }

  /** \return TUM rows, a row each `step` seconds, at x = seconds since 1657900000 */
  static std::string
  tumRows(double start, double step, int count)
  {
    std::string rows;
    for (int i = 0; i < count; ++i) {
      const std::string seconds = std::to_string(start + step * i);
      rows += "165790000" + seconds + ' ' + seconds + " 0 0 0 0 0 1\n";
    }
    return rows;
  }

  ScanFolder
  open(const std::string& rows = "") const
  {
    ScanFolderOptions options;
    if (!rows.empty()) {
      options.poses_file = folder_ / "poses.tum";
      writeText(options.poses_file, rows);
    }
    return ScanFolder(folder_.path(), options);
  }

  const TempFolder folder_;
};
} // namespace

TEST_F(PosesOfScans, EqualPosesDoNotDiffer)
{
  EXPECT_FALSE(open().posesDiffer());
  const Eigen::Isometry3d half_turn(
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ())); // VIEWPOINT 0 0 0 0 0 0 1
  for (int i = 0; i < 4; ++i)
    add(nameOf(i), half_turn);
  const ScanFolder scans = open();
  EXPECT_TRUE(scans.hasPoses());
  EXPECT_FALSE(scans.posesDiffer());
  EXPECT_TRUE(scans.initialPose(3).isApprox(half_turn, 1e-12));
  add(nameOf(2), pcl6d::planarPose(0, 1e-3, M_PI));
  EXPECT_TRUE(open().posesDiffer());
  ScanFolderOptions options; // the selected ones count
  options.first = 1;
  options.last = 3;
  EXPECT_TRUE(ScanFolder(folder_.path(), options).posesDiffer());
  add(nameOf(2), half_turn);
  EXPECT_FALSE(ScanFolder(folder_.path(), options).posesDiffer());
  options.last = 2; // two scans may be taken from one position
  EXPECT_TRUE(ScanFolder(folder_.path(), options).posesDiffer());
}

TEST_F(PosesOfScans, EstimatedPosesCountEvenIfEqual)
{
  ScanFolder scans = open();
  scans.replacePoses(std::vector<Eigen::Isometry3d>(4, Eigen::Isometry3d::Identity()),
                     "tracking");
  EXPECT_TRUE(scans.posesDiffer());
}

TEST_F(PosesOfScans, PosesOfAHigherRateAreMatchedByStamps)
{
  const ScanFolder scans = open(tumRows(0.02, 0.1, 60));
  const double expected[] = {0.52, 1.52, 2.52, 3.52};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(scans.initialPose(i).translation().x(), expected[i], 1e-9);
  EXPECT_NEAR(scans.stamps()[3], 1657900003.52, 1e-6);
  EXPECT_EQ(scans.note(), "");
}

TEST_F(PosesOfScans, PosesOfOtherTimesAreRefusedByTheirNumber)
{
  const auto path = folder_ / "poses.tum";
  // Later by a second; too sparse; and without a pose for the last scan.
  expectIoFailed(
      path, "5 poses, but the folder holds 4 scans", [&] { open(tumRows(5, 0.1, 5)); });
  expectIoFailed(path,
                 "3 poses, but the folder holds 4 scans: no pose for 1657900003.5.pcd",
                 [&] { open(tumRows(0.5, 2, 3)); });
  expectIoFailed(path, "26 poses, but the folder holds 4 scans", [&] {
    open(tumRows(0.5, 0.1, 26));
  });
}

TEST_F(PosesOfScans, StampsThatContradictTheNamesAreNamed)
{
  EXPECT_EQ(open(tumRows(0.6, 1, 4)).note(), ""); // within half a step
  const std::string note = open(tumRows(1.5, 1, 4)).note();
  EXPECT_NE(note.find("poses.tum contradict the names of the scans: "
                      "1657900000.5.pcd has the stamp 1657900001.5"),
            std::string::npos)
      << note;
  fs::remove(folder_ / "poses.tum");
  writeText(folder_ / "times.txt", "0\n1\n2\n3\n"); // of a clock of its own
  EXPECT_EQ(open().note(), "");
  writeText(folder_ / "times.txt", "0\n1\n2.7\n3\n");
  EXPECT_EQ(open().note(),
            "the stamps of times.txt contradict the names of the scans: "
            "1657900002.5.pcd has the stamp 2.7; the order of the names is used");
}

TEST_F(PosesOfScans, PoseFilesOfOtherScansAreNamed)
{
  for (const char* const name : {"b.pose", "a.pose", "c.pose"})
    writeText(folder_ / name, "0 0 100\n0 0 0\n");
  const ScanFolder scans = open();
  EXPECT_FALSE(scans.hasPoses());
  EXPECT_EQ(scans.note(), "3 .pose files not used: no scan has the name of a.pose");
}
