// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <cstring>

namespace {
using pcl6d::castScan;
using pcl6d::RangeOptions;
using pcl6d::RangeScan;
using pcl6d::test::kIdentity;

pcl6d::RayCaster
boxRoom()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-4, -3, -1}, {4, 3, 1.5}, {"room", 0.8});
  return pcl6d::RayCaster(scene);
}

// A wall ahead and nothing else.
pcl6d::RayCaster
loneWall()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {5, -2, -2}, {5.2, 2, 2}, {"wall", 0.5});
  return pcl6d::RayCaster(scene);
}

bool
sameBytes(const RangeScan& a, const RangeScan& b)
{
  if (a.samples.size() != b.samples.size())
    return false;
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    if (std::memcmp(&a.samples[i].range, &b.samples[i].range, sizeof(double)) != 0 ||
        a.samples[i].intensity != b.samples[i].intensity ||
        a.samples[i].triangle != b.samples[i].triangle)
      return false;
  return true;
}
} // namespace

TEST(CastScan, AddsNoiseOfTheGivenSpread)
{
  const auto caster = boxRoom();
  const pcl6d::DrivenScanner scanner;
  RangeOptions options;
  options.noise = 0;
  const RangeScan exact = castScan(caster, scanner, kIdentity, options);
  options.noise = 0.02;
  const RangeScan noisy = castScan(caster, scanner, kIdentity, options);
  double sum = 0;
  double sum_sq = 0;
  const auto count = static_cast<double>(exact.samples.size());
  for (std::size_t i = 0; i < exact.samples.size(); ++i) {
    const double error = noisy.samples[i].range - exact.samples[i].range;
    sum += error;
    sum_sq += error * error;
  }
  // Five standard errors of the mean and of the standard deviation.
  EXPECT_NEAR(sum / count, 0, 5 * options.noise / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_sq / count),
              options.noise,
              5 * options.noise / std::sqrt(2 * count));
}

TEST(CastScan, HasTheSameBytesForEveryThreadCount)
{
  const auto caster = boxRoom();
  const pcl6d::DrivenScanner scanner;
  RangeOptions options;
  options.num_threads = 1;
  const RangeScan expected = castScan(caster, scanner, kIdentity, options);
  for (const unsigned threads : {0u, 2u, 8u}) {
    options.num_threads = threads;
    EXPECT_TRUE(sameBytes(castScan(caster, scanner, kIdentity, options), expected))
        << threads << " threads";
  }
}

TEST(CastScan, HasOtherNoiseForAnotherSeedScanOrLine)
{
  const auto caster = boxRoom();
  const pcl6d::DrivenScanner scanner;
  RangeOptions options;
  const RangeScan first = castScan(caster, scanner, kIdentity, options, 0);
  EXPECT_FALSE(sameBytes(castScan(caster, scanner, kIdentity, options, 1), first));
  options.seed = 2;
  EXPECT_FALSE(sameBytes(castScan(caster, scanner, kIdentity, options, 0), first));
  // The beam straight ahead and the one straight back see the same distance.
  const int middle = first.samples_per_line / 2;
  EXPECT_NE(first.at(0, middle).range, first.at(180, middle).range);
}

TEST(CastScan, MarksMissingReturnsWithNaN)
{
  const auto caster = loneWall();
  const pcl6d::DrivenScanner scanner(pcl6d::pitchingScanner());
  const RangeScan scan = castScan(caster, scanner, kIdentity);
  const auto cloud = toPointCloud(scan, scanner);
  EXPECT_EQ(cloud.width, 181u);
  EXPECT_EQ(cloud.height, 241u);
  EXPECT_FALSE(cloud.is_dense);
  int returns = 0;
  for (int line = 0; line < scan.num_lines; ++line)
    for (int i = 0; i < scan.samples_per_line; ++i) {
      const Eigen::Vector3d at =
          5 * scanner.ray(line, i).direction / scanner.ray(line, i).direction.x();
      const bool is_return = std::abs(at.y()) < 2 && std::abs(at.z()) < 2 && at.x() > 0;
      const auto& point = cloud(i, line);
      returns += is_return;
      ASSERT_EQ(std::isfinite(scan.at(line, i).range), is_return);
      ASSERT_EQ(std::isfinite(point.x), is_return);
      ASSERT_EQ(std::isnan(point.y) && std::isnan(point.z), !is_return);
    }
  EXPECT_GT(returns, 1000);
}

TEST(CastScan, MeasuresOnlyBetweenSmallestAndLargestRange)
{
  const auto caster = loneWall();
  const pcl6d::DrivenScanner scanner(pcl6d::pitchingScanner());
  RangeOptions options;
  options.noise = 0;
  options.min_range = 5.1;
  options.max_range = 5.3;
  const RangeScan scan = castScan(caster, scanner, kIdentity, options);
  int returns = 0;
  for (const auto& sample : scan.samples)
    if (std::isfinite(sample.range)) {
      ++returns;
      ASSERT_GE(sample.range, options.min_range);
      ASSERT_LE(sample.range, options.max_range);
    }
  EXPECT_GT(returns, 100);
  EXPECT_TRUE(std::isnan(scan.at(120, 90).range)); // straight ahead: 5 m
}

TEST(CastScan, GivesReflectanceTimesCosineAsIntensity)
{
  const auto caster = loneWall();
  const pcl6d::DrivenScanner scanner(pcl6d::pitchingScanner());
  const RangeScan scan = castScan(caster, scanner, kIdentity);
  EXPECT_NEAR(scan.at(120, 90).intensity, 0.5, 1e-12);
  EXPECT_NEAR(scan.at(120, 110).intensity, 0.5 * std::cos(20 * M_PI / 180), 1e-12);
}

// A plate before a wall, passed by a fan with a wide spot: the share of samples whose
// spot lies on both is that of its diameter.
TEST(CastScan, HasMixedPixelsWhereTheSpotCrossesAnEdge)
{
  constexpr double kAside = 1e-4; // [m] more than a slanted surface bends a spot
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {5, -1, -1}, {5.01, 1, 1}, {"plate", 0.6});
  pcl6d::addBox(scene, {5.4, -9, -9}, {5.5, 9, 9}, {"wall", 0.6});
  const pcl6d::RayCaster caster(scene);
  pcl6d::DrivenScannerOptions fan;
  fan.beam = {-15 * M_PI / 180, 15 * M_PI / 180, 6001};
  const pcl6d::DrivenScanner scanner(fan);
  RangeOptions options;
  options = options.withoutErrors();
  options.beam = {0.01, 4e-3, 200, HUGE_VAL};
  const RangeScan scan = castScan(caster, scanner, kIdentity, options);
  int mixed = 0;
  for (int i = 0; i < scan.samples_per_line; ++i) {
    const double depth = scan.at(0, i).range * scanner.ray(0, i).direction.x();
    mixed += depth > 5 + kAside && depth < 5.4 - kAside;
  }
  const double edge = std::hypot(5.0, 1.0); // [m] to it
  const double spot = pcl6d::footprintDiameter(edge, 0.01, 4e-3);
  const double expected = 2 * spot / edge / fan.beam.step(); // two edges
  EXPECT_GT(expected, 100);
  RecordProperty("mixed", mixed);
  RecordProperty("expected", std::to_string(expected));
  EXPECT_NEAR(mixed, expected, 0.04 * expected); // no ray lies on the rim of the spot
  // With a separable echo there are none.
  options.beam.echo_separation = 0.2;
  const RangeScan separate = castScan(caster, scanner, kIdentity, options);
  for (int i = 0; i < scan.samples_per_line; ++i) {
    const double depth = separate.at(0, i).range * scanner.ray(0, i).direction.x();
    ASSERT_TRUE(depth < 5 + kAside || depth > 5.4 - kAside) << depth;
  }
}

TEST(ToPointCloud, PutsPointsAtTheirRange)
{
  const auto caster = boxRoom();
  pcl6d::DrivenScannerOptions scanner_options = pcl6d::pitchingScanner();
  scanner_options.lever_arm = {0.1, 0, 0.05};
  const pcl6d::DrivenScanner scanner(scanner_options);
  RangeOptions options;
  options.noise = 0;
  Eigen::Isometry3d pose = kIdentity;
  pose.translation() << 0.3, 0.2, 0.1;
  const RangeScan scan = castScan(caster, scanner, pose, options);
  const auto cloud = toPointCloud(scan, scanner);
  EXPECT_TRUE(cloud.is_dense);
  for (const auto& point : cloud) {
    const Eigen::Vector3d p = pose * point.getVector3fMap().cast<double>();
    const Eigen::Vector3d inside(std::min(p.x() + 4, 4 - p.x()),
                                 std::min(p.y() + 3, 3 - p.y()),
                                 std::min(p.z() + 1, 1.5 - p.z()));
    ASSERT_NEAR(inside.minCoeff(), 0, 1e-6); // float coordinates below 8 m
  }
  EXPECT_THROW(toPointCloud(scan, pcl6d::DrivenScanner()), pcl6d::BadArgument);
}

TEST(RangeOptions, RefusesValuesOutOfRange)
{
  const auto refused = [](auto change) {
    RangeOptions options;
    change(options);
    EXPECT_THROW(options.validate(), pcl6d::BadArgument);
  };
  refused([](auto& o) { o.noise = -0.01; });
  refused([](auto& o) { o.noise = std::nan(""); });
  refused([](auto& o) { o.min_range = -1; });
  refused([](auto& o) { o.max_range = o.min_range; });
}
