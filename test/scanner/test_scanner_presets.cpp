// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scanner/scanner_presets.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::test::kDegree;

namespace {
using namespace pcl6d;

class Preset : public testing::TestWithParam<std::string> {
protected:
  ScannerPreset preset_ = scannerByName(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Scanners,
                         Preset,
                         testing::ValuesIn(scannerNames()),
                         [](const auto& preset) { return preset.param; });
} // namespace

TEST_P(Preset, MeasuresWithinItsDuration)
{
  const ScannerModel& scanner = *preset_.scanner;
  double last = 0;
  for (int line = 0; line < scanner.numLines(); ++line)
    for (int i = 0; i < scanner.samplesPerLine(); i += 13) {
      ASSERT_GE(scanner.time(line, i), 0);
      last = std::max(last, scanner.time(line, i));
      ASSERT_NEAR(scanner.ray(line, i).direction.norm(), 1, 1e-12);
    }
  EXPECT_LT(last, scanner.duration());
}

TEST_P(Preset, TellsItsSize)
{
  EXPECT_EQ(preset_.name, GetParam());
  EXPECT_EQ(preset_.description, scannerDescription(GetParam()));
  const std::string size = std::to_string(preset_.scanner->numLines()) + " x " +
                           std::to_string(preset_.scanner->samplesPerLine());
  if (GetParam() != "rangefinder") {
    EXPECT_NE(preset_.description.find(size), std::string::npos) << size;
  }
}

TEST_P(Preset, TakesAnotherResolution)
{
  for (const double wrong : {0.0, -0.1, 2.0, std::nan("")})
    EXPECT_THROW(scannerByName(GetParam(), wrong), BadArgument) << wrong;
  if (GetParam() == "rangefinder")
    return; // a single beam has no neighbour
  EXPECT_THROW(scannerByName(GetParam(), 1e-300), BadArgument);
  const double step = 3 * kDegree;
  const auto coarse = scannerByName(GetParam(), step).scanner;
  const int line = coarse->numLines() / 2;
  const int sample = coarse->samplesPerLine() / 2;
  const auto angle = [&](int other_line, int other_sample) {
    return std::acos(
        coarse->ray(line, sample)
            .direction.dot(coarse->ray(other_line, other_sample).direction));
  };
  const bool is_rosette = GetParam() == "avia" || GetParam() == "mid360";
  if (!is_rosette) {
    EXPECT_NEAR(angle(line, sample + 1), step, 0.03 * step);
  }
  EXPECT_LT(coarse->samplesPerLine(), preset_.scanner->samplesPerLine());
}

TEST(ScannerByName, KeepsTheSolidAtAnotherResolution)
{
  const auto coarse = scannerByName("rotating", 10 * kDegree).scanner;
  EXPECT_EQ(coarse->numLines(), 36); // the seam is closed once
  EXPECT_EQ(coarse->samplesPerLine(), 13);
  EXPECT_NEAR(coarse->ray(0, 12).direction.z(), std::sin(60 * kDegree), 1e-12);
  EXPECT_NEAR(std::acos(coarse->ray(0, 6).direction.dot(coarse->ray(35, 6).direction)),
              10 * kDegree,
              1e-9);
  const auto nodding = scannerByName("pitching", 0.25 * kDegree).scanner;
  EXPECT_EQ(nodding->numLines(), 481);
  EXPECT_EQ(nodding->samplesPerLine(), 721);
}

TEST(ScannerByName, NamesThoseItKnows)
{
  try {
    scannerByName("sonar");
    FAIL();
  } catch (const BadArgument& e) {
    for (const auto& name : scannerNames())
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
  }
  EXPECT_THROW(scannerDescription("sonar"), BadArgument);
}

TEST(ScannerByName, HasTheFiguresOfTheBook)
{
  const auto pitching = scannerByName("pitching").scanner;
  EXPECT_NEAR(pitching->ray(0, 0).direction.y(), -1, 1e-12); // 180 deg wide
  const auto sick = scannerByName("sick").scanner;
  EXPECT_EQ(sick->numLines(), 1);
  EXPECT_EQ(sick->samplesPerLine(), 181);
  EXPECT_NEAR(sick->duration(), 13e-3, 0.5e-3);
  const auto scandrive = scannerByName("scandrive").scanner;
  EXPECT_EQ(scandrive->numLines() * scandrive->samplesPerLine(), 32580);
  EXPECT_NEAR(scandrive->duration(), 1.2, 1e-12);
  const ScannerPreset tof = scannerByName("tof");
  EXPECT_EQ(tof.scanner->numLines() * tof.scanner->samplesPerLine(), 25344);
  EXPECT_NEAR(tof.range.ambiguity_interval, 7.49, 0.01);
}
