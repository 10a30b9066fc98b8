// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_convert stereo as a user runs it.
#include "scanner/calibration_text.h"
#include "scanner/stereo_rig.h"
#include "support/run_program.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/scanner/image_files.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdlib>

namespace {
using pcl6d::test::calibrationText;
using pcl6d::test::intrinsicsText;
using pcl6d::test::motionEntries;
using pcl6d::test::Outcome;
using pcl6d::test::realRig;
using pcl6d::test::renderPair;
using pcl6d::test::SlantedWall;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kName = "pcl_slam6d_convert";
const SlantedWall kWall{3, 0.2};

/** A folder with the pictures of a wall and their calibration. */
struct Files : TempFolder {
  Files()
  {
    static const auto pair = renderPair(kWall.scene(), realRig(), /*noise=*/2);
    pcl6d::writePng(*this / "left.png", pair.left);
    pcl6d::writePng(*this / "right.png", pair.right);
    writeText(*this / "calib.yml", calibrationText(realRig()));
  }

  std::string
  name(const std::string& file) const
  {
    return *this / file;
  }

  Outcome
  run(const std::vector<std::string>& more) const
  {
    std::vector<std::string> arguments = {
        "stereo", name("left.png"), name("right.png"), name("calib.yml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return pcl6d::test::runProgram(kName, arguments);
  }

  void
  expectRefused(int code,
                const std::vector<std::string>& more,
                const std::vector<std::string>& words) const
  {
    std::vector<std::string> arguments = {"-o", name("out.pcd")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    pcl6d::test::expectError(run(arguments), kName, code, words);
    EXPECT_FALSE(std::filesystem::exists(name("out.pcd")));
  }
};

pcl::PointCloud<pcl::PointXYZI>
read(const std::string& file)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  pcl::fromPCLPointCloud2(pcl6d::readPcd(file), cloud);
  return cloud;
}
} // namespace

TEST(ConvertStereo, TriangulatesAWall)
{
  const Files files;
  const auto outcome = files.run({"-o", files.name("cloud.pcd")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("baseline 0.1192"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("of 76800 pixels"), std::string::npos) << outcome.out;
  const auto fields = pcl6d::readPcd(files.name("cloud.pcd")).fields;
  ASSERT_EQ(fields.size(), 5u);
  EXPECT_EQ(fields[4].name, "depth_error");
  const auto cloud = read(files.name("cloud.pcd"));
  EXPECT_GT(cloud.size(), 60000u);
  EXPECT_EQ(cloud.height, 1u);
  std::size_t near = 0;
  for (const auto& p : cloud) {
    ASSERT_TRUE(std::isfinite(p.x));
    const double depth = kWall.distance + kWall.slope * -double{p.y};
    near += std::abs(p.x - depth) < 3 * 0.25 * depth * depth / 36; // three sigma
  }
  EXPECT_GT(near, cloud.size() * 99 / 100);
}

TEST(ConvertStereo, TakesTwoCalibrationFilesUnitsAndMatchers)
{
  const Files files;
  pcl6d::StereoCalibration rig = realRig();
  rig.T_right_left.translation() *= 1000; // [mm]
  writeText(files / "motion.yml", "%YAML:1.0\n---\n" + motionEntries(rig));
  writeText(files / "calib.yml", intrinsicsText(rig));
  const auto outcome = files.run({"-o",
                                  files.name("cloud.pcd"),
                                  "--extrinsics",
                                  files.name("motion.yml"),
                                  "--unit",
                                  "0.001",
                                  "--matcher",
                                  "bm",
                                  "--block-size",
                                  "9",
                                  "--disparities",
                                  "48",
                                  "--organized"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("baseline 0.1192"), std::string::npos) << outcome.out;
  const auto cloud = read(files.name("cloud.pcd"));
  EXPECT_EQ(cloud.width, 320u);
  EXPECT_EQ(cloud.height, 240u);
  EXPECT_NEAR(cloud.at(200, 120).x, 3, 0.3);
}

TEST(ConvertStereo, GivesTheSameFileOnAnyCpu)
{
  const Files files;
  EXPECT_EQ(files.run({"-o", files.name("a.pcd")}).exit_code, 0);
  ::setenv("OPENCV_CPU_DISABLE", "AVX,AVX2,FMA3,FP16", 1);
  const auto outcome = files.run({"-o", files.name("b.pcd")});
  ::unsetenv("OPENCV_CPU_DISABLE");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pcl6d::test::readText(files / "a.pcd"),
            pcl6d::test::readText(files / "b.pcd"));
}

TEST(ConvertStereo, SaysWhatAnotherFormatDrops)
{
  const Files files;
  const auto outcome = files.run({"-o", files.name("cloud.xyz")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("dropped field 'depth_error'"), std::string::npos)
      << outcome.out;
}

TEST(ConvertStereo, RefusesAWrongCommandLine)
{
  const Files files;
  files.expectRefused(2, {"--matcher", "best"}, {"--matcher = best", "sgbm or bm"});
  files.expectRefused(2, {"--disparities", "50"}, {"--disparities = 50", "of 16"});
  files.expectRefused(2, {"--block-size", "4"}, {"--block-size = 4"});
  files.expectRefused(2, {"--unit", "0"}, {"--unit = 0"});
  files.expectRefused(2, {"--max-depth", "-1"}, {"--max-depth = -1"});
  files.expectRefused(2, {"--sigma", "nan"}, {"--sigma = nan"});
  pcl6d::test::expectError(files.run({}), kName, 2, {"output"});
  pcl6d::test::expectError(
      files.run({"-o", files.name("left.png")}), kName, 2, {"is an input"});
}

TEST(ConvertStereo, NamesWhatIsWrongWithTheData)
{
  const Files files;
  writeText(files / "calib.yml", intrinsicsText(realRig()));
  files.expectRefused(1, {}, {"calib.yml: has no entry R, T"});
  files.expectRefused(
      1, {"--extrinsics", files.name("none")}, {"none: No such file or directory"});
  writeText(files / "calib.yml", calibrationText(realRig()));
  files.expectRefused(1, {"--disparities", "320"}, {"320 x 240", "disparities (320)"});
  pcl6d::writePng(files / "right.png", cv::Mat(240, 319, CV_8UC1, cv::Scalar(0)));
  files.expectRefused(
      1, {}, {"right.png: has 319 x 240 pixels", "left.png has 320 x 240 pixels"});
  for (const char* const dark : {"left.png", "right.png"})
    pcl6d::writePng(files / dark, cv::Mat(240, 320, CV_8UC1, cv::Scalar(0)));
  files.expectRefused(1, {}, {"no pixel of", "has a match"});
  writeText(files / "right.png", "no picture");
  files.expectRefused(1, {}, {"right.png: is no image"});
  std::filesystem::remove(files / "right.png");
  files.expectRefused(1, {}, {"right.png: No such file or directory"});
}
