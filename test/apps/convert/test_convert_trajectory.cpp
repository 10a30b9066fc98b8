// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_convert trajectory as a user runs it.
#include "apps/convert/convert_test.h"
#include "support/poses.h"

#include <pcl6d/io/trajectory_formats.h>
#include <pcl6d/io/trajectory_io.h>

namespace fs = std::filesystem;
using pcl6d::test::converted;
using pcl6d::test::expectConvertError;
using pcl6d::test::TempFolder;

namespace {
pcl6d::Trajectory
randomTrajectory()
{
  pcl6d::Random random(8);
  pcl6d::Trajectory trajectory;
  for (int i = 0; i < 12; ++i) {
    trajectory.poses.push_back(pcl6d::test::randomPose(random, 1e3, 3));
    trajectory.stamps.push_back(1317384506.40528 + 0.1 * i);
  }
  return trajectory;
}
} // namespace

TEST(ConvertTrajectory, EveryPairOfFormatsKeepsThePoses)
{
  const TempFolder folder;
  const pcl6d::Trajectory original = randomTrajectory();
  writeTrajectoryTum(folder / "Süd 1.tum", original);
  const std::vector<std::string> formats = {"kitti", "tum", "g2o", "pose", "frames"};
  for (const auto& first : formats) {
    const std::string there = folder / ("é 1 " + first);
    converted({"trajectory", folder / "Süd 1.tum", "-o", there, "--format", first});
    for (const auto& second : formats) {
      SCOPED_TRACE(first + " to " + second);
      const std::string back = folder / (first + " " + second);
      converted({"trajectory",
                 there,
                 "-o",
                 back,
                 "--format",
                 second,
                 "--input-format",
                 first});
      const auto read =
          pcl6d::readTrajectoryFiles(back, pcl6d::trajectoryFormatFromName(second));
      ASSERT_EQ(read.trajectory.poses.size(), original.poses.size());
      for (std::size_t i = 0; i < original.poses.size(); ++i) {
        const auto error =
            pcl6d::distanceBetween(read.trajectory.poses[i], original.poses[i]);
        EXPECT_LT(error.translation, 1e-12);
        EXPECT_LT(error.rotation, 1e-13);
      }
    }
  }
}

TEST(ConvertTrajectory, TellsWhatBecomesOfTheStamps)
{
  const TempFolder folder;
  const auto trajectory = randomTrajectory();
  const std::string tum = folder / "a.tum", kitti = folder / "a.kitti",
                    other = folder / "b.tum";
  writeTrajectoryTum(tum, trajectory);
  EXPECT_EQ(converted({"trajectory", tum, "-o", other}),
            "12 poses: tum to tum\nstamps kept\n");
  EXPECT_EQ(pcl6d::readTrajectory(other).stamps, trajectory.stamps);
  EXPECT_EQ(converted({"trajectory", tum, "-o", kitti}),
            "12 poses: tum to kitti\ndropped the stamps\n");
  EXPECT_EQ(converted({"trajectory", kitti, "-o", other}),
            "12 poses: kitti to tum\nstamps made from the indices: 0, 1, ...\n");
  EXPECT_EQ(pcl6d::readTrajectory(other).stamps.back(), 11);
}

TEST(ConvertTrajectory, FoldersKeepTheirNames)
{
  const TempFolder folder;
  writeTrajectoryKitti(folder / "a.kitti", randomTrajectory());
  const std::string poses = folder / "poses", frames = folder / "frames";
  converted({"trajectory", folder / "a.kitti", "-o", poses, "--format", "pose"});
  EXPECT_TRUE(fs::exists(folder / "poses/scan011.pose"));
  fs::rename(folder / "poses/scan011.pose", folder / "poses/scan ü.pose");
  EXPECT_EQ(converted({"trajectory", poses, "-o", frames, "--format", "frames"}),
            "12 poses: pose to frames\n");
  EXPECT_TRUE(fs::exists(folder / "frames/scan ü.frames"));
  expectConvertError({"trajectory", poses, "-o", frames, "--format", "frames"},
                     1,
                     {"frames", "not empty"});
}

TEST(ConvertTrajectory, RefusesAWrongCommandLine)
{
  const TempFolder folder;
  const std::string in = folder / "a.kitti", out = folder / "out";
  writeTrajectoryKitti(in, randomTrajectory());
  const std::string before = pcl6d::test::readText(in);
  expectConvertError({"trajectory"}, 2, {"IN"});
  expectConvertError({"trajectory", in}, 2, {"output"});
  expectConvertError({"trajectory", in, "-o", in}, 2, {"is the input"});
  expectConvertError({"trajectory", in, "-o", out}, 2, {"--format is missing", "tum"});
  expectConvertError({"trajectory", in, "-o", out, "--format", "csv"},
                     2,
                     {"--format = 'csv'", "frames"});
  expectConvertError({"trajectory", in, "-o", out + ".tum", "--format", "kitti"},
                     2,
                     {"extension of tum"});
  expectConvertError({"trajectory", in, "-o", out + ".tum", "--input-format", "csv"},
                     2,
                     {"--input-format = 'csv'"});
  EXPECT_EQ(pcl6d::test::readText(in), before);
}

TEST(ConvertTrajectory, NamesWhatIsWrongWithTheData)
{
  const TempFolder folder;
  const std::string in = folder / "a.kitti", out = folder / "out.tum";
  writeTrajectoryKitti(in, randomTrajectory());
  pcl6d::test::writeText(folder / "bad", "1 0 0 0 0 1 0 0 0 0 1 0\n1 2\n");
  expectConvertError(
      {"trajectory", folder / "bad", "-o", out}, 1, {"bad", "line 2", "12 numbers"});
  expectConvertError(
      {"trajectory", folder / "none", "-o", out}, 1, {"none", "No such"});
  expectConvertError(
      {"trajectory", in, "-o", out, "--input-format", "tum"}, 1, {"rows of kitti"});
  expectConvertError(
      {"trajectory", folder.path(), "-o", out}, 1, {"no .pose and no .frames"});
  expectConvertError({"trajectory", in, "-o", in + "/x.tum"}, 1, {"x.tum"});
  expectConvertError(
      {"trajectory", in, "-o", in + "/x", "--format", "pose"}, 1, {"cannot write"});
  EXPECT_FALSE(fs::exists(out));
}
