// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_convert depth and calibrate as a user runs them.
#include "apps/convert/convert_test.h"
#include "scanner/rendered_board.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/scanner/camera_file.h>
#include <pcl6d/scanner/image_files.h>
#include <pcl6d/scanner/stereo_calibration_file.h>

#include <opencv2/imgcodecs.hpp>

#include <filesystem>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::boardCamera;
using pcl6d::test::boardPicture;
using pcl6d::test::boardPoses;
using pcl6d::test::converted;
using pcl6d::test::expectConvertError;
using pcl6d::test::TempFolder;
using Words = std::vector<std::string>;

constexpr const char* kIntrinsics = "100,100,31.5,23.5"; // of 64 x 48 pixels

/** A folder "in" of depth images. */
class ConvertDepth : public testing::Test {
protected:
  ConvertDepth() { fs::create_directory(in); }

  /** \param[in] value of all pixels but the first, which has none */
  void
  write(const std::string& name, int type, double value, int width = 64) const
  {
    cv::Mat image(48, width, type, cv::Scalar::all(value));
    if (image.channels() == 1)
      image.row(0).col(0).setTo(0);
    ASSERT_TRUE(cv::imwrite(in / name, image));
  }

  Words
  words(Words more) const
  {
    more.insert(more.begin(), {"depth", in, "-o", out});
    return more;
  }

  void
  expectRefused(int code, const Words& more, const Words& expected) const
  {
    expectConvertError(words(more), code, expected);
    EXPECT_TRUE(!fs::exists(out) || fs::is_empty(out));
  }

  const TempFolder folder;
  const fs::path in = folder / "in", out = folder / "out";
};

/** Expects a wall across x at a distance, seen by all pixels but the first. */
void
expectWall(const fs::path& file, double distance)
{
  const auto scan = pcl6d::readScan(file);
  EXPECT_EQ(scan.points.size(), 64u * 48 - 1);
  EXPECT_EQ(scan.dropped, 1u);
  EXPECT_EQ(scan.row_length, 64u);
  for (const auto& p : scan.points)
    ASSERT_NEAR(p.x(), distance, 1e-6 * distance);
  // The second pixel is 30.5 px left of the axis and 23.5 px above it.
  EXPECT_NEAR(scan.points[0].y(), distance * 0.305, 1e-5);
  EXPECT_NEAR(scan.points[0].z(), distance * 0.235, 1e-5);
}
} // namespace

TEST_F(ConvertDepth, MakesScansOfImagesOfSixteenBitsAndOfFloatingPoint)
{
  write("scan2.png", CV_16UC1, 2500);
  write("scan10.tiff", CV_32FC1, 1.25);
  const auto said = converted(words({"--intrinsics", kIntrinsics, "--quiet"}));
  EXPECT_NE(said.find("2 scans, 6142 points"), std::string::npos) << said;
  expectWall(out / "scan2.pcd", 2.5);
  expectWall(out / "scan10.pcd", 1.25);
}

TEST_F(ConvertDepth, TakesAUnitACameraFileAndASingleImage)
{
  write("a.png", CV_16UC1, 12500); // as TUM's benchmark: 5000 steps a metre
  pcl6d::CameraIntrinsics lens;
  lens.width = 64;
  lens.height = 48;
  lens.fx = lens.fy = 100;
  lens.cx = 31.5;
  lens.cy = 23.5;
  pcl6d::writeCamera(folder / "camera.yml", lens);
  const std::string scan = folder / "a.pcd";
  converted({"depth",
             in / "a.png",
             "-o",
             scan,
             "--camera",
             folder / "camera.yml",
             "--unit",
             "0.0002"});
  expectWall(scan, 2.5);
}

TEST_F(ConvertDepth, TurnsPhasesIntoRadialRanges)
{
  write("a.png", CV_16UC1, 16384); // a quarter of a turn
  fs::create_directory(folder / "amplitudes");
  cv::imwrite(folder / "amplitudes/a.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(77)));
  const auto said = converted(words({"--intrinsics",
                                     kIntrinsics,
                                     "--modulation",
                                     "2e7",
                                     "--amplitudes",
                                     folder / "amplitudes"}));
  EXPECT_NE(said.find("repeat after 7.495 m"), std::string::npos) << said;
  const auto scan = pcl6d::readScan(out / "a.pcd");
  ASSERT_EQ(scan.points.size(), 64u * 48 - 1);
  for (const auto& p : scan.points)
    ASSERT_NEAR(p.norm(), 7.49481145 / 4, 1e-6);
  EXPECT_EQ(pcl6d::test::floatOf(scan.cloud, 5, "intensity"), 77);
}

TEST_F(ConvertDepth, NamesWhatIsWrong)
{
  write("a.png", CV_16UC1, 2500);
  expectRefused(2, {}, {"camera is not known", "--camera", "--intrinsics"});
  expectRefused(2, {"--intrinsics", "1,2,3"}, {"intrinsics"});
  expectRefused(2, {"--intrinsics", "0,1,3,4"}, {"--intrinsics", "fx = 0"});
  const Words known = {"--intrinsics", kIntrinsics};
  const auto with = [&](const Words& more) {
    Words all = known;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expectRefused(2, with({"--unit", "0"}), {"--unit = 0"});
  expectRefused(2, with({"--turn", "7"}), {"--turn needs --modulation"});
  expectRefused(2, with({"--kind", "deep"}), {"--kind", "axis"});
  expectRefused(1, with({"--max-range", "1"}), {"a.png: no pixel has a depth"});
  write("b.png", CV_16UC1, 2500, 65);
  expectRefused(1, known, {"b.png: has 65 x 48 pixels", "a.png has 64 x 48"});
  write("b.png", CV_8UC3, 99);
  expectRefused(1, known, {"b.png: has 3 channels of 8 bits", "16 bits"});
  fs::remove(in / "b.png");
  pcl6d::writeCamera(folder / "camera.yml", boardCamera());
  expectRefused(1,
                {"--camera", folder / "camera.yml"},
                {"camera.yml: entry image_width is 320, but the images have 64"});
  fs::remove(in / "a.png");
  expectRefused(1, known, {"in: holds no picture"});
}

TEST_F(ConvertDepth, KeepsTheWordsOfOpenCvToItself)
{
  write("a.pgm", CV_16UC1, 2500);
  fs::resize_file(in / "a.pgm", fs::file_size(in / "a.pgm") / 2);
  const auto outcome = pcl6d::test::convert(words({"--intrinsics", kIntrinsics}));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err.rfind("pcl_slam6d_convert: error: ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("a.pgm: is no image"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("OpenCV("), std::string::npos) << outcome.err;
}

TEST_F(ConvertDepth, DoesNotPassOverPicturesThatAreNoFiles)
{
  write("a.png", CV_16UC1, 2500);
  const Words known = {"--intrinsics", kIntrinsics};
  for (const char* const target : {"nowhere", "b.png", "/dev/zero"}) {
    fs::create_symlink(target, in / "b.png");
    expectRefused(1, known, {"b.png: is no file"});
    fs::remove(in / "b.png");
  }
}

namespace {
constexpr double kFocalTol = 2; // [px], as of the library's test on pictures

void
writePictures(const fs::path& folder,
              const std::string& name,
              const Eigen::Isometry3d& T_camera_first)
{
  const pcl6d::Chessboard board;
  fs::create_directories(folder);
  int number = 0;
  for (const auto& pose : boardPoses(board))
    pcl6d::writePng(folder / (name + std::to_string(++number) + ".png"),
                    boardPicture(board, T_camera_first * pose));
}

void
expectBoardCamera(const pcl6d::CameraIntrinsics& found)
{
  EXPECT_NEAR(found.fx, boardCamera().fx, kFocalTol);
  EXPECT_NEAR(found.fy, boardCamera().fy, kFocalTol);
  EXPECT_NEAR(found.cx, boardCamera().cx, kFocalTol);
  EXPECT_NEAR(found.cy, boardCamera().cy, kFocalTol);
  EXPECT_NEAR(found.k[0], boardCamera().k[0], 0.02);
}
} // namespace

TEST(ConvertCalibrate, FindsTheCameraOfRenderedBoards)
{
  const TempFolder folder;
  writePictures(folder / "in", "board", Eigen::Isometry3d::Identity());
  pcl6d::writePng(folder / "in/dark.png", cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)));
  const std::string file = folder / "camera.json";
  const auto said = converted(
      {"calibrate", folder / "in", "-o", file, "--board", "9x6", "--square", "0.03"});
  EXPECT_NE(said.find("no board in " + (folder / "in/dark.png").string()),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("of 13 pictures show the board"), std::string::npos) << said;
  EXPECT_NE(said.find("rms 0.0"), std::string::npos) << said;
  expectBoardCamera(pcl6d::readCamera(file));
}

TEST(ConvertCalibrate, FindsTwoCamerasByNamesAndByFolders)
{
  const TempFolder folder;
  const Eigen::Isometry3d T_right_left =
      pcl6d::poseFromEuler({-0.02, 0, 0}, {0, 0.01, 0});
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  writePictures(folder / "both", "left", still);
  writePictures(folder / "both", "right", T_right_left);
  writePictures(folder / "l", "a", still);
  writePictures(folder / "r", "a", T_right_left);
  const std::string first = folder / "a.yml", second = folder / "b.yml";
  const auto said = converted({"calibrate", folder / "both", "-o", first});
  EXPECT_NE(said.find("baseline 0.0"), std::string::npos) << said;
  converted({"calibrate", folder / "l", "--right", folder / "r", "-o", second});
  EXPECT_EQ(pcl6d::test::readText(first), pcl6d::test::readText(second));
  const auto rig = pcl6d::readStereoCalibration({first, {}}, 320, 240);
  expectBoardCamera(rig.left);
  expectBoardCamera(rig.right);
  const auto error = pcl6d::distanceBetween(T_right_left, rig.T_right_left);
  EXPECT_LT(error.translation, 2e-3); // a tenth of a pixel at 0.42 m, and the lenses
  EXPECT_LT(error.rotation, 5e-3);
}

TEST(ConvertCalibrate, NamesWhatIsWrong)
{
  const TempFolder folder;
  const fs::path in = folder / "in";
  fs::create_directory(in);
  const std::string file = folder / "camera.yml";
  const auto refused = [&](int code, Words more, const Words& expected) {
    more.insert(more.begin(), {"calibrate", in, "-o", file});
    expectConvertError(more, code, expected);
    EXPECT_FALSE(fs::exists(file));
  };
  const cv::Mat dark(240, 320, CV_8UC1, cv::Scalar(9));
  refused(1, {}, {"in: holds no picture"});
  for (const char* const name : {"a.png", "b.png", "c.png"})
    pcl6d::writePng(in / name, dark);
  refused(1, {}, {"in: 0 of 3 pictures show the whole board", "--board 9x6"});
  refused(2, {"--board", "9"}, {"board"});
  refused(2, {"--board", "9x1"}, {"--board", "1"});
  refused(2, {"--square", "0"}, {"--square = 0"});
  pcl6d::writePng(in / "c.png", cv::Mat(240, 321, CV_8UC1, cv::Scalar(9)));
  refused(1, {}, {"c.png: has 321 x 240 pixels", "a.png has 320 x 240"});
  fs::remove(in / "c.png");
  pcl6d::writePng(in / "left1.png", dark);
  pcl6d::writePng(in / "right2.png", dark);
  refused(1, {}, {"left1.png and", "right2.png", "no pair"});
}
