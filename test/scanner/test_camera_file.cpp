// SPDX-License-Identifier: BSD-3-Clause
// Camera files, calibration of two cameras, lists of pictures.
#include "scanner/expect_refused.h"
#include "scanner/rendered_board.h"
#include "scanner/stereo_rig.h"
#include "small_camera.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/scanner/calibrate_stereo.h>
#include <pcl6d/scanner/camera_file.h>
#include <pcl6d/scanner/image_files.h>
#include <pcl6d/scanner/stereo_calibration_file.h>

#include <opencv2/core.hpp>

#include <algorithm>

namespace {
using pcl6d::CalibrationView;
using pcl6d::CameraIntrinsics;
using pcl6d::IoFailed;
using pcl6d::Status;
using pcl6d::test::boardCamera;
using pcl6d::test::boardPoses;
using pcl6d::test::expectRefused;
using pcl6d::test::expectSame;
using pcl6d::test::realRig;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** A camera whose numbers take all digits. */
CameraIntrinsics
unevenCamera()
{
  CameraIntrinsics lens = boardCamera();
  lens.fx = 310 + 1.0 / 3;
  lens.cy = 117 - 1e-9;
  lens.skew = 0.1;
  lens.k = {-0.1 / 3, 0.08, 1e-17, 0, 0, 0};
  return lens;
}
} // namespace

TEST(CameraFile, GivesBackTheCameraInEachFormat)
{
  const TempFolder folder;
  for (const char* const name : {"a.yml", "a.yaml", "a.xml", "a.json"}) {
    SCOPED_TRACE(name);
    pcl6d::writeCamera(folder / name, unevenCamera());
    expectSame(pcl6d::readCamera(folder / name), unevenCamera());
    expectSame(pcl6d::readCamera(folder / name, 320, 240), unevenCamera());
  }
  CameraIntrinsics rational = unevenCamera();
  rational.k[4] = 1e-3;
  pcl6d::writeCamera(folder / "r.yml", rational);
  expectSame(pcl6d::readCamera(folder / "r.yml"), rational);
}

TEST(CameraFile, GivesBackTwoCameras)
{
  const TempFolder folder;
  pcl6d::writeStereoCalibration(folder / "rig.yml", realRig());
  const auto back = pcl6d::readStereoCalibration(
      {folder / "rig.yml", {}}, realRig().left.width, realRig().left.height);
  expectSame(back.left, realRig().left);
  expectSame(back.right, realRig().right);
  EXPECT_LT((back.T_right_left.matrix() - realRig().T_right_left.matrix()).norm(),
            1e-15);
  expectSame(pcl6d::readCamera(folder / "rig.yml"), realRig().left);
}

TEST(CameraFile, IsReadWithTheNamesOfOpenCvsSample)
{
  const TempFolder folder;
  pcl6d::writeCamera(folder / "a.yml", unevenCamera());
  std::string text = pcl6d::test::readText(folder / "a.yml");
  text.replace(text.find("M1:"), 2, "camera_matrix");
  text.replace(text.find("D1:"), 2, "distortion_coefficients");
  writeText(folder / "b.yml", text);
  expectSame(pcl6d::readCamera(folder / "b.yml"), unevenCamera());
}

TEST(CameraFile, SaysWhatIsWrong)
{
  const TempFolder folder;
  const auto refused = [&](const std::string& name, const std::string& words) {
    expectRefused<IoFailed>([&] { pcl6d::readCamera(folder / name); }, words);
  };
  refused("none.yml", "none.yml: No such file or directory");
  writeText(folder / "bad.yml", "%YAML:1.0\n---\nM1: 3\n");
  refused("bad.yml", "has no entry D1");
  pcl6d::writeCamera(folder / "a.yml", unevenCamera());
  expectRefused<IoFailed>([&] { pcl6d::readCamera(folder / "a.yml", 640, 240); },
                          "entry image_width is 320, but the images have 640");
  std::string text = pcl6d::test::readText(folder / "a.yml");
  text.replace(text.find("320"), 3, "-32");
  writeText(folder / "b.yml", text);
  refused("b.yml", "entry image_width is no whole number > 0");
  expectRefused<IoFailed>([&] { pcl6d::writeCamera(folder / "a.txt", unevenCamera()); },
                          ".yml");
  CameraIntrinsics bad;
  bad.fx = 0;
  expectRefused([&] { pcl6d::writeCamera(folder / "c.yml", bad); }, "fx = 0");
  EXPECT_FALSE(std::filesystem::exists(folder / "c.yml"));
}

TEST(CalibrateStereo, FindsTheMotionBetweenTheCameras)
{
  const pcl6d::Chessboard board;
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({-0.12, 0.003, 0.004}, {0.01, -0.02, 0.005});
  std::vector<CalibrationView> left, right;
  for (const auto& pose : boardPoses(board)) {
    left.push_back(pcl6d::test::exactView(board, pose));
    right.push_back(pcl6d::test::exactView(board, truth * pose));
    if (right.size() % 2) // a board may count from its other end
      std::reverse(right.back().pixels.begin(), right.back().pixels.end());
  }
  const auto result = pcl6d::calibrateStereo(left, right, 320, 240);
  ASSERT_EQ(result.status, Status::kOk);
  const auto error = pcl6d::distanceBetween(truth, result.calibration.T_right_left);
  EXPECT_LT(error.translation, 1e-4); // OpenCV keeps pixels in float
  EXPECT_LT(error.rotation, 1e-4);
  EXPECT_LT(result.rms, 1e-3);
  EXPECT_NEAR(result.calibration.right.fx, boardCamera().fx, 0.1);
}

TEST(CalibrateStereo, SaysWhenThereIsNoAnswerAndRefusesWhatAreNoPairs)
{
  const pcl6d::Chessboard board;
  const auto view = pcl6d::test::exactView(board, boardPoses(board).front());
  EXPECT_EQ(pcl6d::calibrateStereo({view, view}, {view, view}, 320, 240).status,
            Status::kTooFewPairs);
  expectRefused([&] { pcl6d::calibrateStereo({view}, {}, 320, 240); },
                "number of right views = 0");
  auto other = view;
  other.points.front().x() += 1;
  expectRefused([&] { pcl6d::calibrateStereo({view}, {other}, 320, 240); },
                "points of right view = 0");
}

TEST(CameraFile, IsNotReadDeeperThanAnybodyWritesIt)
{
  const TempFolder folder;
  for (const auto& [name, start, level] :
       {std::tuple("a.yaml", "%YAML:1.0\n---\na: ", "["),
        std::tuple("b.yaml", "%YAML:1.0\n---\na: ", "{a: "),
        std::tuple("c.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n", "<a>"),
        std::tuple("d.json", "{\n\"a\":\n", "[")})
    for (const int depth : {20000, 500000}) {
      SCOPED_TRACE(name);
      std::string deep = start;
      for (int i = 0; i < depth; ++i)
        deep += level;
      writeText(folder / name, deep);
      expectRefused<IoFailed>([&] { pcl6d::readCamera(folder / name); },
                              "line 3: nested more than 200 deep");
    }
}

TEST(ImagesOf, AreThePicturesOfAFolderInNaturalOrder)
{
  const TempFolder folder;
  expectRefused<IoFailed>([&] { pcl6d::imagesOf(folder / "."); }, "holds no picture");
  for (const char* const name : {"b10.png", "b9.PNG", "a.tiff", "notes.txt"})
    writeText(folder / name, "");
  std::vector<std::string> names;
  for (const auto& path : pcl6d::imagesOf(folder / "."))
    names.push_back(path.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"a.tiff", "b9.PNG", "b10.png"}));
  expectRefused<IoFailed>([&] { pcl6d::imagesOf(folder / "none"); }, "cannot be read");
}
