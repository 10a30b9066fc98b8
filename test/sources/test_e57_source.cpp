// SPDX-License-Identifier: BSD-3-Clause
// What an E57 file means: coordinates, missing returns, colours, grids, poses, names.
#include "sources/made_e57.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/sources/e57_source.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace pcl6d::test;
using pcl6d::E57Source;
using pcl6d::ScanCloud;

class E57SourceTest : public testing::Test {
protected:
  E57Source
  open(const std::vector<MadeScan>& scans) const
  {
    makeE57(folder_ / "site.e57", scans);
    return E57Source(folder_ / "site.e57");
  }
  ScanCloud
  readOnly(const MadeScan& scan) const
  {
    return open({scan}).read(0);
  }
  static std::vector<double>
  valuesOf(const ScanCloud& scan, const std::string& field)
  {
    const auto values = pcl6d::fieldValues(scan.cloud, field);
    EXPECT_TRUE(values) << field;
    return values ? values->values : std::vector<double>();
  }
  /** \return per point whether it has no coordinates */
  static std::vector<bool>
  missing(const ScanCloud& scan)
  {
    std::vector<bool> result;
    for (const double x : valuesOf(scan, "x"))
      result.push_back(std::isnan(x));
    return result;
  }

  TempFolder folder_;
};

const MadeScan kThree = scanOfPoints({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
constexpr const char* kPoseText =
    "<pose type=\"Structure\"><rotation type=\"Structure\"><w type=\"Float\">0.6</w><x "
    "type=\"Float\">0</x><y type=\"Float\"/><z "
    "type=\"Float\">0.8</z></rotation><translation "
    "type=\"Structure\"><x type=\"Float\">4</x><y type=\"Float\">5e0</y><z "
    "type=\"Float\">-6</z></translation></pose>";

TEST_F(E57SourceTest, SphericalCoordinatesBecomeCartesian)
{
  constexpr double kPi = 3.14159265358979323846;
  MadeScan scan;
  scan.fields = {realsOf("sphericalRange", {2, 2, 2, 2, 0}),
                 realsOf("sphericalAzimuth", {0, kPi / 2, kPi, 0.3, 1}),
                 realsOf("sphericalElevation", {0, 0, 0, kPi / 2, 1})};
  const ScanCloud cloud = readOnly(scan);
  const auto x = valuesOf(cloud, "x"), y = valuesOf(cloud, "y"),
             z = valuesOf(cloud, "z");
  const double expected[4][3] = {{2, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, 0, 2}};
  constexpr double kFloat = 2e-7 * 2; // [m] half an ulp of float at 2 m
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(x[i], expected[i][0], kFloat);
    EXPECT_NEAR(y[i], expected[i][1], kFloat);
    EXPECT_NEAR(z[i], expected[i][2], kFloat);
  }
  EXPECT_TRUE(std::isnan(x[4])); // a range of 0 is no return
}

TEST_F(E57SourceTest, InvalidStatesAndTheOriginAreNoReturns)
{
  const std::vector<std::vector<double>> points = {
      {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {0, 0, 0}};
  for (const bool is_integer : {true, false}) {
    MadeScan scan = scanOfPoints(points);
    scan.fields.push_back(
        is_integer ? integersOf("cartesianInvalidState", 0, 2, {0, 1, 2, 0})
                   : realsOf("cartesianInvalidState", {0, 1, 2, 0}, E57Kind::kSingle));
    EXPECT_EQ(missing(readOnly(scan)), (std::vector<bool>{false, true, true, true}));
  }
  MadeScan spherical;
  spherical.fields = {realsOf("sphericalRange", {1, 1}),
                      realsOf("sphericalAzimuth", {0, 0}),
                      realsOf("sphericalElevation", {0, 0}),
                      integersOf("sphericalInvalidState", 0, 2, {2, 0})};
  EXPECT_EQ(missing(readOnly(spherical)), (std::vector<bool>{true, false}));
}

TEST_F(E57SourceTest, ColoursAreScaledToEightBitsByTheirLimits)
{
  MadeScan scan = kThree;
  scan.fields.push_back(integersOf("colorRed", 0, 65535, {0, 32768, 65535}));
  scan.fields.push_back(integersOf("colorGreen", 0, 1023, {0, 1000, 100}));
  scan.fields.push_back(realsOf("colorBlue", {0, 0.5, 1}, E57Kind::kSingle));
  scan.about =
      "<colorLimits type=\"Structure\"><colorGreenMinimum type=\"Integer\"/>"
      "<colorGreenMaximum type=\"Integer\">1000</colorGreenMaximum></colorLimits>";
  const ScanCloud cloud = readOnly(scan);
  const std::uint8_t expected[3][3] = {{0, 0, 0}, {128, 255, 128}, {255, 26, 255}};
  const auto& rgb = cloud.cloud.fields.back();
  ASSERT_EQ(rgb.name, "rgb");
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) // blue, green, red in memory
      EXPECT_EQ(cloud.cloud.data[i * cloud.cloud.point_step + rgb.offset + 2 - c],
                expected[i][c]);
}

TEST_F(E57SourceTest, OtherFieldsKeepTheirNumbersAndUnknownOnesAreNamed)
{
  MadeScan scan = kThree;
  scan.fields.push_back(integersOf("intensity", -66, 66, {-66, 0, 66}));
  scan.fields.push_back(integersOf("isIntensityInvalid", 0, 1, {0, 0, 1}));
  scan.fields.push_back(realsOf("nor:normalX", {0, 1, 0}));
  scan.fields.push_back(realsOf("timeStamp", {0.25, 1e9, 1e9 + 1e-6}));
  scan.fields.push_back(integersOf("las:pointSourceId", 0, 9, {1, 2, 3}));
  const ScanCloud cloud = readOnly(scan);
  EXPECT_EQ(valuesOf(cloud, "intensity"), (std::vector<double>{-66, 0, 0}));
  EXPECT_EQ(valuesOf(cloud, "normal_x"), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(valuesOf(cloud, "time"), (std::vector<double>{0.25, 1e9, 1e9 + 1e-6}));
  EXPECT_EQ(cloud.left_out, std::vector<std::string>{"field 'las:pointSourceId'"});
}

TEST_F(E57SourceTest, AGridBecomesRowsWithItsHoles)
{
  MadeScan scan = kThree;
  scan.fields.push_back(integersOf("rowIndex", 0, 9, {6, 5, 6}));
  scan.fields.push_back(integersOf("columnIndex", 0, 9, {1, 2, 2}));
  ScanCloud cloud = readOnly(scan);
  EXPECT_EQ(cloud.cloud.height, 2U);
  EXPECT_EQ(cloud.cloud.width, 2U);
  EXPECT_EQ(missing(cloud), (std::vector<bool>{true, false, false, false}));
  EXPECT_EQ(valuesOf(cloud, "y")[1], 5);
  EXPECT_EQ(valuesOf(cloud, "y")[3], 8);
  scan.about =
      "<pointGroupingSchemes type=\"Structure\"><groupingByLine type=\"Structure\">"
      "<idElementName type=\"String\">columnIndex</idElementName></groupingByLine>"
      "</pointGroupingSchemes>";
  cloud = readOnly(scan); // its lines are columns
  EXPECT_EQ(missing(cloud), (std::vector<bool>{true, false, false, false}));
  EXPECT_EQ(valuesOf(cloud, "y")[1], 2);
  scan.fields.back().integers = {1, 2, 1}; // two points in a cell: a list
  EXPECT_EQ(readOnly(scan).cloud.height, 1U);
  scan.fields.back() = integersOf("columnIndex", 0, 4000000000, {1, 2, 4000000000});
  EXPECT_EQ(readOnly(scan).cloud.height, 1U); // nearly empty: no memory for its cells
}

TEST_F(E57SourceTest, PosesMayHaveNoRotationOrNoTranslation)
{
  MadeScan whole = kThree, moved = kThree, turned = kThree;
  whole.about = kPoseText;
  moved.about = "<pose type=\"Structure\"><translation type=\"Structure\"><x "
                "type=\"Float\">1</x></translation></pose>";
  turned.about = "<pose type=\"Structure\"><rotation type=\"Structure\"><w "
                 "type=\"Float\">0</w><x type=\"Float\">1</x></rotation></pose>";
  const E57Source source = open({whole, moved, turned, kThree});
  const Eigen::Isometry3d pose = *source.scans()[0].pose;
  EXPECT_LT((pose.translation() - Eigen::Vector3d(4, 5, -6)).norm(), 1e-15);
  // A turn about z with cos(a / 2) = 0.6: cos a = -0.28, sin a = 0.96.
  EXPECT_LT((pose.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d(-0.28, 0.96, 0))
                .norm(),
            1e-15);
  EXPECT_EQ(source.scans()[1].pose->translation(), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(source.scans()[1].pose->linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(source.scans()[2].pose->linear(),
            Eigen::Matrix3d(Eigen::Vector3d(1, -1, -1).asDiagonal()));
  EXPECT_EQ(source.scans()[3].pose->matrix(), Eigen::Matrix4d::Identity());
  EXPECT_FALSE(open({kThree}).scans()[0].pose); // no scan has one
}

TEST_F(E57SourceTest, NamesAreDistinctAndInOneLine)
{
  const auto named = [](const std::string& name) {
    MadeScan scan = kThree;
    scan.about = "<name type=\"String\">" + name + "</name>";
    return scan;
  };
  const E57Source source = open({named("Lobby"),
                                 named("Lobby"),
                                 kThree,
                                 named("A &amp; B\n/C"),
                                 named("Lobby (1)"),
                                 named("..")});
  std::vector<std::string> names;
  for (const auto& scan : source.scans())
    names.push_back(scan.name);
  EXPECT_EQ(
      names,
      (std::vector<std::string>{
          "Lobby", "Lobby (1)", "scan002", "A & B _C", "Lobby (1) (4)", "scan005"}));
  EXPECT_EQ(source.scans()[0].num_points, 3U);
  EXPECT_EQ(source.scans()[0].fields,
            (std::vector<std::string>{"cartesianX", "cartesianY", "cartesianZ"}));
}

TEST_F(E57SourceTest, StampsAreStartsThatAscend)
{
  const auto started = [](double seconds) {
    MadeScan scan = kThree;
    scan.about = "<acquisitionStart type=\"Structure\"><dateTimeValue type=\"Float\">" +
                 std::to_string(seconds) + "</dateTimeValue></acquisitionStart>";
    return scan;
  };
  EXPECT_EQ(open({started(10), started(20)}).scans()[1].stamp, 20);
  EXPECT_FALSE(open({started(0), started(0)}).scans()[1].stamp);
  EXPECT_FALSE(open({started(10), kThree}).scans()[0].stamp);
}

TEST_F(E57SourceTest, FarPointsComeInDoubleAndNearOnesAsFloat)
{
  MadeScan far =
      scanOfPoints({{512345.125, 5403210.0625, 1}, {512346.125, 5403211.0625, 2}});
  ScanCloud cloud = readOnly(far);
  EXPECT_EQ(cloud.cloud.fields[0].datatype, pcl::PCLPointField::FLOAT64);
  EXPECT_EQ(valuesOf(cloud, "y")[1], 5403211.0625);
  EXPECT_EQ(readOnly(kThree).cloud.fields[0].datatype, pcl::PCLPointField::FLOAT32);
}

TEST_F(E57SourceTest, AScanWithoutPointsIsEmpty)
{
  const E57Source source = open({scanOfPoints({}), kThree});
  EXPECT_EQ(source.read(0).cloud.width, 0U);
  EXPECT_EQ(source.read(1).cloud.width, 3U);
}

} // namespace
