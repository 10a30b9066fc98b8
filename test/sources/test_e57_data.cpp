// SPDX-License-Identifier: BSD-3-Clause
// Files that other programs wrote.
#include "support/data_folder.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/e57_poses.h>
#include <pcl6d/sources/e57_source.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using pcl6d::E57Source;

/** \brief What a file is known to hold. */
struct KnownFile {
  const char* folder;
  const char* name;
  std::vector<std::size_t> points;  ///< of each scan
  std::vector<std::size_t> missing; ///< of these, without coordinates
};

std::vector<double>
valuesOf(const pcl6d::ScanCloud& scan, const char* field)
{
  const auto values = pcl6d::fieldValues(scan.cloud, field);
  EXPECT_TRUE(values) << field;
  return values ? values->values : std::vector<double>();
}

std::size_t
countMissing(const pcl6d::ScanCloud& scan)
{
  const auto x = valuesOf(scan, "x");
  return static_cast<std::size_t>(
      std::count_if(x.begin(), x.end(), [](double v) { return std::isnan(v); }));
}

TEST(E57Data, FilesOfOtherProgramsHoldWhatTheyAreKnownFor)
{
  // Points as the files' recordCount says; missing ones are at (0, 0, 0) or invalid.
  const KnownFile known[] = {
      {"e57", "bunnyInt32.e57", {30571}, {0}},
      {"e57", "ColouredCubeDouble.e57", {7680}, {0}},
      {"e57", "ColouredCubeFloat.e57", {7680}, {0}},
      {"e57", "ColourRepresentation.e57", {153}, {0}},
      {"e57", "ZeroPoints.e57", {0}, {0}},
      {"e57", "ZeroPointsInvalid.e57", {0}, {0}},
      {"formats/e57", "A_B.e57", {2, 4}, {0, 0}},
      {"formats/e57", "bunnyInt19.e57", {30571}, {0}},
      {"formats/e57", "cartesian_invalid_state_single.e57", {3}, {2}},
      {"formats/e57", "integer_intensity.e57", {2}, {0}},
      {"formats/e57", "no_ext_namespace.e57", {1}, {0}},
      {"formats/e57", "tiny_pc_and_images.e57", {2}, {1}},
      {"formats/e57", "tiny_spherical.e57", {360}, {180}},
      {"formats/e57", "translationWithoutRotation.e57", {4}, {1}}};
  for (const auto& file : known) {
    SCOPED_TRACE(file.name);
    PCL6D_DATA_OR_SKIP(folder, file.folder);
    const E57Source source(folder / file.name);
    ASSERT_EQ(source.scans().size(), file.points.size());
    for (std::size_t i = 0; i < file.points.size(); ++i) {
      const pcl6d::ScanCloud scan = source.read(i);
      EXPECT_EQ(std::size_t{scan.cloud.width} * scan.cloud.height, file.points[i]);
      EXPECT_EQ(source.scans()[i].num_points, file.points[i]);
      EXPECT_EQ(countMissing(scan), file.missing[i]);
    }
  }
}

TEST(E57Data, BrokenFilesAreRefusedByWhatIsBroken)
{
  PCL6D_DATA_OR_SKIP(old, "e57");
  PCL6D_DATA_OR_SKIP(formats, "formats/e57");
  const std::pair<std::filesystem::path, std::string> broken[] = {
      {old / "empty.e57", "holds no scan"},
      {old / "bad-crc.e57", "page 0 (bytes from 0): wrong checksum"},
      {old / "InvalidCVHeader.e57",
       "scan 0: the points begin with the section type 182"},
      {formats / "corrupt_crc.e57", "wrong checksum"}};
  for (const auto& [path, word] : broken) {
    std::string message = "read";
    try {
      E57Source(path).read(0);
    } catch (const pcl6d::IoFailed& e) {
      message = e.what();
    }
    EXPECT_NE(message.find(word), std::string::npos) << path << ": " << message;
  }
}

TEST(E57Data, TheBunnyIsTheSameInNineteenAndInThirtyTwoBits)
{
  PCL6D_DATA_OR_SKIP(old, "e57");
  PCL6D_DATA_OR_SKIP(formats, "formats/e57");
  const auto wide = E57Source(old / "bunnyInt32.e57").read(0);
  const auto narrow = E57Source(formats / "bunnyInt19.e57").read(0);
  // The bounds that the file of 32 bits gives in its XML section.
  const double bounds[3][2] = {
      {-0.094689, 0.061009}, {0.040011, 0.187321}, {-0.061873, 0.058799}};
  constexpr double kStep = 1e-6;          // [m] of both files
  constexpr double kFloat = 0.5e-7 * 0.2; // [m] half an ulp of float at 0.2 m
  for (int axis = 0; axis < 3; ++axis) {
    const char name[] = {static_cast<char>('x' + axis), 0};
    const auto a = valuesOf(wide, name), b = valuesOf(narrow, name);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      ASSERT_NEAR(a[i], b[i], kStep);
    const auto [low, high] = std::minmax_element(a.begin(), a.end());
    EXPECT_NEAR(*low, bounds[axis][0], 2 * kFloat);
    EXPECT_NEAR(*high, bounds[axis][1], 2 * kFloat);
  }
}

TEST(E57Data, SphericalPointsLieWhereTheyWereMeasured)
{
  PCL6D_DATA_OR_SKIP(folder, "formats/e57");
  const auto scan = E57Source(folder / "tiny_spherical.e57").read(0);
  const auto x = valuesOf(scan, "x"), y = valuesOf(scan, "y"), z = valuesOf(scan, "z");
  // The file's points: range 1 m, azimuth = elevation = i times a step, every other one valid.
  constexpr double kStep = 0.008722222222222223; // [rad]
  constexpr double kFloat = 2e-7;                // [m]
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle = kStep * static_cast<double>(i);
    if (std::isnan(x[i]))
      continue; // counted above
    ASSERT_NEAR(x[i], std::cos(angle) * std::cos(angle), kFloat);
    ASSERT_NEAR(y[i], std::cos(angle) * std::sin(angle), kFloat);
    ASSERT_NEAR(z[i], std::sin(angle), kFloat);
  }
}

TEST(E57Data, ATranslationWithoutARotationIsAPose)
{
  PCL6D_DATA_OR_SKIP(folder, "formats/e57");
  const E57Source source(folder / "translationWithoutRotation.e57");
  ASSERT_TRUE(source.scans()[0].pose);
  EXPECT_EQ(source.scans()[0].pose->translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(source.scans()[0].pose->linear(), Eigen::Matrix3d::Identity());
}

TEST(E57Data, PosesGoIntoFilesOfOtherProgramsAndTheirImagesStay)
{
  PCL6D_DATA_OR_SKIP(folder, "formats/e57");
  const pcl6d::test::TempFolder out;
  const auto from = folder / "tiny_pc_and_images.e57";
  Eigen::Isometry3d pose(Eigen::Translation3d(1, 2, 3));
  pcl6d::writeE57Poses(from, out / "a.e57", {pose});
  EXPECT_EQ(E57Source(out / "a.e57").scans()[0].pose->translation(),
            Eigen::Vector3d(1, 2, 3));
  const std::string a = pcl6d::test::readText(from);
  const std::string b = pcl6d::test::readText(out / "a.e57");
  constexpr std::size_t kXml =
      11172; // where the XML section begins, as its header says
  ASSERT_GT(a.size(), kXml);
  EXPECT_EQ(a.substr(1024, kXml / 1024 * 1024 - 1024),
            b.substr(1024, kXml / 1024 * 1024 - 1024));
}

} // namespace
