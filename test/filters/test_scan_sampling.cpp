// SPDX-License-Identifier: BSD-3-Clause
// How far the points and the lines of a scan lie apart, against patterns of known angles.
#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/scan_sampling.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using pcl6d::Points;
using pcl6d::samplingOf;
using pcl6d::ScanSampling;
using pcl6d::ScanStructure;

namespace {
constexpr double kDegree = 3.14159265358979 / 180;

/** \return the range to the walls, floor and ceiling of a box of 8 x 6 x 3 m about the
 * scanner */
double
rangeInBox(const Eigen::Vector3d& ray)
{
  const Eigen::Array3d half(4, 3, 1.5);
  return (half / ray.array().abs()).minCoeff();
}

Eigen::Vector3d
rayAt(double azimuth, double elevation)
{
  return {std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/** \return a turn of a spinning lidar in a box: rings about z, with noise of the range */
Points
ringScan(int rings, double pitch, double step, double noise = 0.01)
{
  pcl6d::Random random(1);
  Points points;
  for (int ring = 0; ring < rings; ++ring)
    for (double azimuth = 0; azimuth < 360 * kDegree; azimuth += step) {
      const Eigen::Vector3d ray = rayAt(azimuth, (ring - 0.5 * (rings - 1)) * pitch);
      points.push_back(
          ((rangeInBox(ray) + noise * random.normal()) * ray).cast<float>());
    }
  return points;
}
} // namespace

TEST(ScanSampling, OfRingsIsTheirPitch)
{
  const ScanSampling sampling = samplingOf(ringScan(16, 2 * kDegree, 0.2 * kDegree));
  EXPECT_EQ(sampling.structure, ScanStructure::kRings);
  EXPECT_EQ(sampling.rings, 16u);
  EXPECT_NEAR(sampling.line_angle, 2 * kDegree, 0.03 * kDegree);
  EXPECT_NEAR(sampling.point_angle, 0.2 * kDegree, 0.01 * kDegree);
  EXPECT_NEAR(sampling.highest, 15 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(sampling.lowest, -15 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(
      sampling.lineSpacing(), sampling.line_angle * sampling.median_range, 1e-12);
  EXPECT_NE(sampling.text().find("16 rings 2 deg apart, at "), std::string::npos)
      << sampling.text();
}

TEST(ScanSampling, DoesNotDependOnTheOrderOfPoints)
{
  Points points = ringScan(32, 1.33 * kDegree, 0.2 * kDegree);
  const ScanSampling ordered = samplingOf(points);
  pcl6d::Random random(7);
  for (std::size_t i = points.size() - 1; i > 0; --i)
    std::swap(points[i],
              points[static_cast<std::size_t>(random.uniform() *
                                              static_cast<double>(i + 1))]);
  const ScanSampling shuffled = samplingOf(points);
  EXPECT_EQ(shuffled.structure, ordered.structure);
  EXPECT_EQ(shuffled.rings, ordered.rings);
  EXPECT_NEAR(shuffled.line_angle, ordered.line_angle, 0.05 * ordered.line_angle);
}

TEST(ScanSampling, DoesNotDependOnTheScaleOfTheScene)
{
  Points points = ringScan(16, 2 * kDegree, 0.2 * kDegree);
  const ScanSampling metres = samplingOf(points);
  for (auto& p : points)
    p *= 0.001F;
  const ScanSampling kilometres = samplingOf(points);
  EXPECT_EQ(kilometres.structure, metres.structure);
  EXPECT_NEAR(kilometres.line_angle, metres.line_angle, 1e-3 * metres.line_angle);
  EXPECT_NEAR(kilometres.lineSpacing(), 0.001 * metres.lineSpacing(), 1e-5);
}

TEST(ScanSampling, IsSeenFromTheOriginOfTheScanner)
{
  Points points = ringScan(16, 2 * kDegree, 0.2 * kDegree);
  const ScanSampling own = samplingOf(points);
  const Eigen::Vector3f origin(30, -20, 10);
  for (auto& p : points)
    p += origin;
  const ScanSampling moved = samplingOf(points, origin);
  EXPECT_EQ(moved.structure, ScanStructure::kRings);
  EXPECT_NEAR(moved.line_angle, own.line_angle, 1e-3 * own.line_angle);
  EXPECT_NEAR(moved.median_range, own.median_range, 1e-4);
}

TEST(ScanSampling, OfAGridIsEven)
{
  Points points;
  for (double elevation = -30; elevation <= 30; elevation += 0.5)
    for (double azimuth = -40; azimuth <= 40; azimuth += 0.5) {
      const Eigen::Vector3d ray = rayAt(azimuth * kDegree, elevation * kDegree);
      points.push_back((rangeInBox(ray) * ray).cast<float>());
    }
  const ScanSampling sampling = samplingOf(points);
  EXPECT_EQ(sampling.structure, ScanStructure::kEven);
  EXPECT_EQ(sampling.rings, 0u);
  EXPECT_NEAR(sampling.line_angle, 0.5 * kDegree, 0.1 * kDegree);
}

TEST(ScanSampling, OfRandomDirectionsIsEven)
{
  pcl6d::Random random(3);
  Points points;
  while (points.size() < 20000) {
    const Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    points.push_back((rangeInBox(p.normalized()) * p.normalized()).cast<float>());
  }
  EXPECT_EQ(samplingOf(points).structure, ScanStructure::kEven);
}

TEST(ScanSampling, OfStandingRingsAreLines)
{
  // A line scanner that is turned about the vertical: its lines stand upright.
  Points points = ringScan(60, 3 * kDegree, 0.25 * kDegree);
  for (auto& p : points)
    p = Eigen::Vector3f(p.z(), p.y(), p.x());
  const ScanSampling sampling = samplingOf(points);
  EXPECT_EQ(sampling.structure, ScanStructure::kLines);
  EXPECT_NEAR(sampling.line_angle, 3 * kDegree, 0.1 * kDegree);
}

TEST(ScanSampling, KnowsASingleLine)
{
  const ScanSampling sampling = samplingOf(ringScan(1, kDegree, 0.5 * kDegree));
  EXPECT_EQ(sampling.structure, ScanStructure::kOneLine);
  EXPECT_EQ(sampling.line_angle, 0);
  EXPECT_EQ(sampling.lineSpacing(), 0);
  EXPECT_NEAR(sampling.point_angle, 0.5 * kDegree, 0.01 * kDegree);
}

TEST(ScanSampling, CountsCopiesOfAPointOnce)
{
  Points points = ringScan(16, 2 * kDegree, 0.4 * kDegree);
  const ScanSampling once = samplingOf(points);
  const Points copy = points;
  for (int k = 0; k < 3; ++k)
    points.insert(points.end(), copy.begin(), copy.end());
  const ScanSampling copied = samplingOf(points);
  EXPECT_EQ(copied.structure, once.structure);
  EXPECT_NEAR(copied.line_angle, once.line_angle, 0.05 * once.line_angle);
}

TEST(ScanSampling, OfWhatIsNoScanIsNothing)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float far = std::numeric_limits<float>::infinity();
  EXPECT_EQ(samplingOf({}).line_angle, 0);
  EXPECT_EQ(samplingOf({{nan, 0, 0}, {far, 0, 0}, {0, 0, 0}}).line_angle, 0);
  EXPECT_EQ(samplingOf({{1, 0, 0}}).line_angle, 0);
  const ScanSampling same = samplingOf(Points(1000, Eigen::Vector3f(1, 2, 3)));
  EXPECT_EQ(same.line_angle, 0);
  EXPECT_EQ(same.point_angle, 0);
  EXPECT_NEAR(same.median_range, std::sqrt(14.0), 1e-5);
}

TEST(ScanParametersOfRings, TakeTheVoxelFromTheLines)
{
  // Rings of 2 degrees: the points of a ring lie 1 cm apart, the rings 8 to 14.
  const Points scan = ringScan(16, 2 * kDegree, 0.2 * kDegree);
  const ScanSampling sampling = samplingOf(scan);
  const pcl6d::ScanParameters p = pcl6d::deriveScanParameters({}, {scan});
  EXPECT_NEAR(
      p.voxel.value, 1.3 * sampling.lineSpacing(), 0.06 * sampling.lineSpacing());
  EXPECT_NE(p.voxel.why.find("1.3 x line-spacing"), std::string::npos) << p.voxel.why;
  EXPECT_NE(p.line_spacing.why.find("16 rings"), std::string::npos)
      << p.line_spacing.why;
}

TEST(ScanParametersOfRings, TakeALineSpacingThatIsGiven)
{
  const Points scan = ringScan(16, 2 * kDegree, 0.2 * kDegree);
  pcl6d::ScanParameterOptions given;
  given.line_spacing = 0.2;
  const pcl6d::ScanParameters p = pcl6d::deriveScanParameters(given, {scan});
  EXPECT_TRUE(p.line_spacing.given);
  EXPECT_NEAR(p.voxel.value, 0.26, 1e-12);
  // What is printed gives the same, and none is as for a scan without lines.
  const pcl6d::ScanParameters derived = pcl6d::deriveScanParameters({}, {scan});
  given.line_spacing = derived.line_spacing.value;
  EXPECT_EQ(pcl6d::deriveScanParameters(given, {scan}).voxel.value,
            derived.voxel.value);
  given.line_spacing = 0;
  EXPECT_LT(pcl6d::deriveScanParameters(given, {scan}).voxel.value,
            0.7 * derived.voxel.value);
  // A voxel that is given stays.
  given.line_spacing = 0.2;
  given.voxel = 0.03;
  EXPECT_EQ(pcl6d::deriveScanParameters(given, {scan}).voxel.value, 0.03);
}

TEST(ScanParametersOfRings, RefuseALineSpacingThatIsNone)
{
  for (const double bad : {-0.1,
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    pcl6d::ScanParameterOptions given;
    given.line_spacing = bad;
    try {
      given.validate();
      FAIL() << bad;
    } catch (const pcl6d::BadArgument& error) {
      EXPECT_NE(std::string(error.what()).find("line_spacing"), std::string::npos)
          << error.what();
    }
  }
}
