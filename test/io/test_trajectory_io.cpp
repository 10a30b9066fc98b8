// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/poses.h"

#include <pcl6d/io/trajectory_io.h>

using pcl6d::readTrajectory;
using pcl6d::readUosPose;
using pcl6d::Trajectory;
using pcl6d::writeTrajectoryKitti;
using pcl6d::writeTrajectoryTum;
using pcl6d::test::DecimalComma;
using pcl6d::test::expectIoFailed;
using pcl6d::test::kRotationTolerance;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

// A rotation is re-normalised on reading: a few ulp of its entries.

Trajectory
makeTrajectory()
{
  pcl6d::Random random(1);
  Trajectory trajectory;
  for (int i = 0; i < 20; ++i) {
    trajectory.poses.push_back(pcl6d::test::randomPose(random, 50, 3.0));
    trajectory.poses.back().translation() +=
        Eigen::Vector3d(691234.567, 5336789.123, 0);
    trajectory.stamps.push_back(1317384506.40528 + 0.1 * i);
  }
  return trajectory;
}

void
expectSamePoses(const Trajectory& a, const Trajectory& b)
{
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].translation(), b.poses[i].translation()); // all digits
    EXPECT_LT(pcl6d::distanceBetween(a.poses[i], b.poses[i]).rotation,
              kRotationTolerance);
  }
}

const std::string kIdentityRow = "1 0 0 0 0 1 0 0 0 0 1 0\n";

} // namespace

TEST(TrajectoryIo, KittiRowsKeepAllDigits)
{
  const TempFolder folder;
  const Trajectory written = makeTrajectory();
  writeTrajectoryKitti(folder / "t.kitti", written);
  const Trajectory read = readTrajectory(folder / "t.kitti");
  expectSamePoses(written, read);
  EXPECT_TRUE(read.stamps.empty());
}

TEST(TrajectoryIo, TumRowsKeepAllDigitsAndTheStamps)
{
  const TempFolder folder;
  const Trajectory written = makeTrajectory();
  writeTrajectoryTum(folder / "t.tum", written);
  const Trajectory read = readTrajectory(folder / "t.tum");
  expectSamePoses(written, read);
  EXPECT_EQ(written.stamps, read.stamps);
}

TEST(TrajectoryIo, RowsHaveTheOrderOfTheirFormats)
{
  const TempFolder folder;
  writeText(folder / "kitti", "# a comment\n\n0 -1 0 1 1 0 0 2 0 0 1 3\r\n");
  writeText(folder / "tum", "  # stamp\n7.5 1 2 3 0 0 0.70710678 0.70710678");
  const auto expected = pcl6d::poseFromEuler({1, 2, 3}, {0, 0, M_PI / 2});
  for (const char* const name : {"kitti", "tum"}) {
    const Trajectory read = readTrajectory(folder / name);
    ASSERT_EQ(read.poses.size(), 1u);
    EXPECT_TRUE(read.poses[0].isApprox(expected, 1e-15)) << name;
  }
  EXPECT_EQ(readTrajectory(folder / "tum").stamps, std::vector<double>{7.5});
}

TEST(TrajectoryIo, ADecimalCommaElsewhereChangesNothing)
{
  const TempFolder folder;
  const Trajectory written = makeTrajectory();
  writeTrajectoryKitti(folder / "point", written);
  const DecimalComma locale;
  writeTrajectoryKitti(folder / "comma", written);
  EXPECT_EQ(pcl6d::test::readText(folder / "point"),
            pcl6d::test::readText(folder / "comma"));
  expectSamePoses(written, readTrajectory(folder / "comma"));
}

TEST(TrajectoryIo, RoundedRotationsAreMadeExactlyRigid)
{
  const TempFolder folder;
  writeText(folder / "t", "0.866 -0.5 0 1 0.5 0.866 0 2 0 0 1 3\n");
  const auto pose = readTrajectory(folder / "t").poses.at(0);
  EXPECT_TRUE(pcl6d::isRigid(pose, 1e-14));
  EXPECT_NEAR(pcl6d::rotationAngle(pose.linear()), M_PI / 6, 1e-3);
}

TEST(TrajectoryIo, BrokenFilesAreNamedWithLineValueAndRule)
{
  const TempFolder folder;
  const auto path = folder / "odometry.txt";
  const auto expectMessage = [&](const std::string& content,
                                 const std::string& message) {
    writeText(path, content);
    expectIoFailed(path, message, [&] { readTrajectory(path); });
  };
  expectMessage("", "holds no pose");
  expectMessage("# nothing\n\n", "holds no pose");
  expectMessage(
      "1 2 3\n",
      "line 1: expected 12 numbers (KITTI) or 8 (TUM), or 9, 13, 16 or 17, got 3");
  expectMessage(kIdentityRow + "1 0 0 0 0 1 0 0 0 0 1\n",
                "line 2: expected 12 numbers, got 11");
  expectMessage(kIdentityRow + kIdentityRow + "1 0 0 0 0 1 0 abc 0 0 1 0\n",
                "line 3: 'abc' is not a number");
  expectMessage(kIdentityRow + "1 0 0 1,5 0 1 0 0 0 0 1 0\n",
                "line 2: '1,5' is not a number");
  expectMessage("1 0 0 1e999 0 1 0 0 0 0 1 0\n", "line 1: '1e999' is not a number");
  expectMessage("#\n1.5 0 0 0 0 1 0 0 0 0 1 0\n",
                "line 2: not a rigid motion (largest entry of |R^T R - I| is 1.25)");
  expectMessage("1 0 0 0 0 1 0 0 0 0 -1 0\n",
                "line 1: not a rigid motion (its rotation mirrors: determinant -1)");
  expectMessage("1 0 0 nan 0 1 0 0 0 0 1 0\n",
                "line 1: not a rigid motion (a number is not finite)");
  expectMessage("0 0 0 0 0 0 0 0.5\n",
                "line 1: not a rigid motion (the quaternion has norm 0.5, but must "
                "have 1)");
  expectMessage("0 inf 0 0 0 0 0 1\n",
                "line 1: not a rigid motion (a number is not finite)");
  for (const char* far : {"1e9", "-1e100"}) {
    const std::string error = "the position is 1e9 m or farther from the origin";
    expectMessage("1 0 0 0 0 1 0 0 0 0 1 " + std::string(far) + "\n",
                  "line 1: " + error);
    expectMessage(kIdentityRow + "1 0 0 " + far + " 0 1 0 0 0 0 1 0\n",
                  "line 2: " + error);
    expectMessage(std::string("0 ") + far + " 0 0 0 0 0 1\n", "line 1: " + error);
  }
  expectMessage("2 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n",
                "line 2: the stamp 2 does not follow 2; stamps must increase");
  expectMessage("nan 0 0 0 0 0 0 1\n", "line 1: the stamp nan is not finite");
}

TEST(TrajectoryIo, FilesThatCannotBeReadAreNamedWithTheReason)
{
  const TempFolder folder;
  expectIoFailed(folder / "missing", "No such file or directory", [&] {
    readTrajectory(folder / "missing");
  });
  expectIoFailed(
      folder.path(), "Is a directory", [&] { readTrajectory(folder.path()); });
}

TEST(TrajectoryIo, TumWithoutAStampPerPoseIsTheCallersMistake)
{
  const TempFolder folder;
  Trajectory trajectory = makeTrajectory();
  trajectory.stamps.pop_back();
  EXPECT_EQ(messageOf<pcl6d::BadArgument>(
                [&] { writeTrajectoryTum(folder / "t", trajectory); }),
            "a TUM trajectory needs a stamp per pose, but has 19 stamps and 20 poses");
  EXPECT_TRUE(pcl6d::test::namesIn(folder.path()).empty());
}

TEST(UosPose, ForwardUpAndRightBecomeForwardUpAndLeft)
{
  const TempFolder folder;
  // 3 cm forward, 1 cm right, 2 cm up; a quarter turn about the upward axis, which
  // 3DTK counts towards the right.
  writeText(folder / "scan000.pose", "1 2 3\n0 90 0\n\n");
  const auto pose = readUosPose(folder / "scan000.pose");
  EXPECT_TRUE(pose.translation().isApprox(Eigen::Vector3d(0.03, -0.01, 0.02), 1e-15));
  const Eigen::Vector3d forward = pose.linear() * Eigen::Vector3d::UnitX();
  EXPECT_LT((forward - Eigen::Vector3d(0, -1, 0)).norm(), 1e-15);
}

TEST(UosPose, IsTheConjugateOf3dtksMatrix)
{
  const TempFolder folder;
  writeText(folder / "scan000.pose", "-300 70.5 1569\n11 -47 123\n");
  const double a = 11 * M_PI / 180, b = -47 * M_PI / 180, c = 123 * M_PI / 180;
  Eigen::Matrix4d T; // rows of 3DTK's documentation, left-handed [cm]
  T << cos(b) * cos(c), -cos(b) * sin(c), sin(b), -300, //
      sin(a) * sin(b) * cos(c) + cos(a) * sin(c),
      -sin(a) * sin(b) * sin(c) + cos(a) * cos(c), -sin(a) * cos(b), 70.5, //
      -cos(a) * sin(b) * cos(c) + sin(a) * sin(c),
      cos(a) * sin(b) * sin(c) + sin(a) * cos(c), cos(a) * cos(b), 1569, //
      0, 0, 0, 1;
  Eigen::Matrix4d C; // left-handed [cm] to ours [m]
  C << 0, 0, 0.01, 0, -0.01, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, 0, 1;
  const Eigen::Matrix4d expected = C * T * C.inverse();
  EXPECT_LT((readUosPose(folder / "scan000.pose").matrix() - expected).norm(), 1e-13);
}

TEST(UosPose, BrokenFilesAreNamedWithLineValueAndRule)
{
  const TempFolder folder;
  const auto path = folder / "scan000.pose";
  const auto expectMessage = [&](const std::string& content,
                                 const std::string& message) {
    writeText(path, content);
    expectIoFailed(path, message, [&] { readUosPose(path); });
  };
  const std::string rule = "expected 6 numbers (position in cm, angles in degrees), ";
  expectMessage("", rule + "got 0");
  expectMessage("0 0 0\n0 0\n", rule + "got 5");
  expectMessage("0 0 0\n0 0 0 0\n", rule + "got 7");
  expectMessage("0 0 0\n0 x 0\n", "line 2: 'x' is not a number");
  expectMessage("0 nan 0\n0 0 0\n", "line 1: a number is not finite");
  expectMessage("0 0 0\n0 1e300 0\n", "an angle is out of range");
}
