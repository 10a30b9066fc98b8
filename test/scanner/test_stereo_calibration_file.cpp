// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/calibration_text.h"
#include "scanner/expect_refused.h"
#include "scanner/stereo_rig.h"
#include "small_camera.h"
#include "support/temp_folder.h"

#include <pcl6d/scanner/stereo_calibration_file.h>

namespace {
using pcl6d::CameraIntrinsics;
using pcl6d::IoFailed;
using pcl6d::readStereoCalibration;
using pcl6d::StereoCalibration;
using pcl6d::test::calibrationText;
using pcl6d::test::expectRefused;
using pcl6d::test::expectSame;
using pcl6d::test::intrinsicsText;
using pcl6d::test::matrixEntry;
using pcl6d::test::motionEntries;
using pcl6d::test::realRig;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** \return the text without the entry, up to the next one */
std::string
without(const std::string& entry, std::string text)
{
  const auto begin = text.find("\n" + entry + ":") + 1;
  auto end = begin;
  do
    end = text.find('\n', end) + 1;
  while (end < text.size() && text[end] == ' ');
  return text.erase(begin, end - begin);
}
} // namespace

TEST(StereoCalibrationFile, GivesBackEveryNumber)
{
  const TempFolder folder;
  StereoCalibration rig = realRig();
  rig.left.skew = 0.5;
  rig.right.k = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  writeText(folder / "one.yml", calibrationText(rig));
  writeText(folder / "lenses.yml", intrinsicsText(rig));
  writeText(folder / "motion.yml", "%YAML:1.0\n---\n" + motionEntries(rig));
  for (const auto& source : {pcl6d::StereoCalibrationSource{folder / "one.yml", {}, 1},
                             pcl6d::StereoCalibrationSource{
                                 folder / "lenses.yml", folder / "motion.yml", 1e-3}}) {
    const auto read = readStereoCalibration(source, 320, 240);
    expectSame(read.left, rig.left);
    expectSame(read.right, rig.right);
    EXPECT_LT((read.T_right_left.linear() - rig.T_right_left.linear()).norm(), 1e-15);
    EXPECT_LT(
        (read.T_right_left.translation() - source.unit * rig.T_right_left.translation())
            .norm(),
        1e-15);
  }
}

TEST(StereoCalibrationFile, UnderstandsXmlAndShortDistortion)
{
  const TempFolder folder;
  std::string text = "<?xml version=\"1.0\"?>\n<opencv_storage>\n";
  const auto add =
      [&](const std::string& name, const std::string& size, const char* data) {
        text += "<" + name + " type_id=\"opencv-matrix\">" + size + "<dt>d</dt><data>" +
                data + "</data></" + name + ">\n";
      };
  for (const char* const number : {"1", "2"}) {
    add("M" + std::string(number), "<rows>3</rows><cols>3</cols>", "9 0 3 0 8 2 0 0 1");
    add("D" + std::string(number), "<rows>4</rows><cols>1</cols>", "0.1 0.2 0.3 0.4");
  }
  add("R", "<rows>3</rows><cols>3</cols>", "1 0 0 0 1 0 0 0 1");
  add("T", "<rows>1</rows><cols>3</cols>", "-2 0 0");
  writeText(folder / "calib.xml", text + "</opencv_storage>\n");
  const auto read = readStereoCalibration({folder / "calib.xml", {}, 1}, 6, 4);
  EXPECT_EQ(read.left.k, (std::array<double, 6>{0.1, 0.2, 0, 0, 0, 0}));
  EXPECT_EQ(read.left.p, (std::array<double, 2>{0.3, 0.4}));
  EXPECT_EQ(read.T_right_left.translation().x(), -2);
}

TEST(StereoCalibrationFile, NamesWhatIsMissing)
{
  const TempFolder folder;
  const auto file = folder / "calib.yml";
  const auto refused = [&](const std::string& text, const std::string& words) {
    writeText(file, text);
    expectRefused<IoFailed>(
        [&] {
          readStereoCalibration({file, {}, 1}, 320, 240);
        },
        words);
  };
  const std::string good = calibrationText(realRig());
  for (const char* const entry : {"M1", "D1", "M2", "D2", "R", "T"})
    refused(without(entry, good), std::string("calib.yml: has no entry ") + entry);
  refused(intrinsicsText(realRig()), "has no entry R, T");
  refused("%YAML:1.0\n---\n", "has no entry M1, D1, M2, D2, R, T");
  refused("", "is no YAML, XML or JSON");
  refused("nonsense", "is no YAML, XML or JSON");
  expectRefused<IoFailed>(
      [&] {
        readStereoCalibration({folder / "none.yml", {}, 1}, 320, 240);
      },
      "none.yml: No such file or directory");
  writeText(file, intrinsicsText(realRig()));
  expectRefused<IoFailed>(
      [&] {
        readStereoCalibration({file, file, 1}, 320, 240);
      },
      "has no entry R, T");
}

TEST(StereoCalibrationFile, TakesOrRefusesABrokenText)
{
  const TempFolder folder;
  const auto file = folder / "calib.yml";
  const std::string good = calibrationText(realRig());
  pcl6d::Random random(1);
  const auto place = [&](const std::string& text) {
    return static_cast<std::size_t>(
        random.uniform(0, static_cast<double>(text.size())));
  };
  std::size_t taken = 0;
  for (int i = 0; i < 300; ++i) {
    std::string text = good;
    switch (i % 4) {
    case 0:
      text[place(text)] = static_cast<char>(random.uniform(32, 127));
      break;
    case 1:
      text.erase(place(text), 10);
      break;
    case 2:
      text.insert(place(text), text.substr(place(text), 10));
      break;
    default:
      text.resize(place(text) + 1);
    }
    writeText(file, text);
    try {
      readStereoCalibration({file, {}, 1}, 320, 240);
      ++taken;
    } catch (const IoFailed& e) {
      EXPECT_NE(std::string(e.what()).find("calib.yml: "), std::string::npos);
    } // anything else ends the test
  }
  EXPECT_GT(taken, 0u);
  EXPECT_LT(taken, 150u);
}

TEST(StereoCalibrationFile, NamesWhatIsWrong)
{
  const TempFolder folder;
  const auto file = folder / "calib.yml";
  const auto refused = [&](const std::string& entry, // replaces one of that name
                           const std::string& words) {
    const std::string name = entry.substr(0, entry.find(':'));
    writeText(file, without(name, "\n" + calibrationText(realRig())).substr(1) + entry);
    expectRefused<IoFailed>(
        [&] {
          readStereoCalibration({file, {}, 1}, 320, 240);
        },
        words);
  };
  refused("M1: 5\n", "entry M1 is no matrix");
  refused(matrixEntry("M2", 2, {1, 0, 0, 1}), "entry M2 has 4 values");
  refused(matrixEntry("M2", 3, {1, 0, 0, 0, 1, 0, 0, 0, 2}), "M2 is no camera matrix");
  refused(matrixEntry("M1", 3, {-9, 0, 0, 0, 1, 0, 0, 0, 1}), "entry M1: fx = -9");
  refused(matrixEntry("D1", 1, {1, 2, 3}), "entry D1 has 3 values");
  refused(matrixEntry("D2", 1, std::vector<double>(14, 0.1)), "D2 has a coefficient");
  refused(matrixEntry("R", 3, std::vector<double>(9, 0.3)), "R is no rotation");
  refused(matrixEntry("R", 3, {1, 0, 0, 0, 1, 0, 0, 0, -1}), "R is no rotation");
  refused(matrixEntry("T", 3, {0, 0, 0}), "baseline = 0");
  refused(
      "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ .nan, 0, 0 ]\n",
      "entry T holds infinity or NaN");
  writeText(file, calibrationText(realRig()) + "image_width: 640\n");
  expectRefused<IoFailed>(
      [&] {
        readStereoCalibration({file, {}, 1}, 320, 240);
      },
      "image_width is 640");
  expectRefused([&] { readStereoCalibration({file, {}, 0}, 320, 240); }, "unit = 0");
}
