// SPDX-License-Identifier: BSD-3-Clause
#include "small_camera.h"
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/projection_scanner.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/cast_scan.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;
using pcl6d::test::exactRanges;
using pcl6d::test::kDegree;
using pcl6d::test::kIdentity;
using pcl6d::test::kPlate;
using pcl6d::test::plateAndWall;
using pcl6d::test::smallCamera;

StripeProjectorOptions
smallProjector()
{
  StripeProjectorOptions options;
  options.baseline = 0.2;
  options.vergence = 5 * kDegree;
  options.columns = 256;
  options.focal_length = 250;
  options.height = 0.5;
  return options;
}
} // namespace

TEST(StripeProjector, ColumnAndLightPlaneAgree)
{
  for (const double baseline : {0.2, -0.3}) {
    StripeProjectorOptions options = smallProjector();
    options.baseline = baseline;
    const StripeProjector projector(options);
    EXPECT_LT((projector.position() - Eigen::Vector3d(0, -baseline, 0)).norm(), 1e-15);
    Random random(4);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p(
          random.uniform(0.5, 3), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
      const auto plane = projector.lightPlane(projector.column(p));
      ASSERT_NEAR(plane.signedDistance(p), 0, 1e-12);
      ASSERT_NEAR(plane.normal().norm(), 1, 1e-12);
    }
    // The axis of the projector crosses that of the camera at b / tan(vergence).
    const Eigen::Vector3d cross(std::abs(baseline) / std::tan(options.vergence), 0, 0);
    EXPECT_NEAR(projector.column(cross), (options.columns - 1) / 2.0, 1e-9);
    EXPECT_TRUE(std::isnan(projector.column({-1, 0, 0})));
    EXPECT_FALSE(projector.lights({-1, 0, 0}));
    EXPECT_TRUE(projector.lights(cross));
    EXPECT_FALSE(projector.lights({1, 3, 0}));
    EXPECT_FALSE(projector.lights({1, 0, 0.28}));
  }
}

TEST(ProjectionScanner, DecodesPatternsToTheTrueRange)
{
  const ProjectionScanner scanner(smallCamera(), smallProjector(), 9, 1.0 / 60);
  EXPECT_DOUBLE_EQ(scanner.duration(), 0.15);
  const RangeScan truth = castScan(plateAndWall(), scanner, kIdentity, exactRanges());
  const double width = 8; // [px] stripe of the Gray code
  int returns = 0;
  for (int row = 0; row < truth.num_lines; ++row)
    for (int col = 0; col < truth.samples_per_line; ++col) {
      const double range = truth.at(row, col).range;
      if (std::isnan(range))
        continue;
      ++returns;
      // What the camera sees on the surface: bits and four shifted waves.
      const Ray ray = scanner.ray(row, col);
      const double column = scanner.lightSource()->column(range * ray.direction) + 0.5;
      const auto code = grayCode(static_cast<unsigned>(column / width));
      std::vector<double> waves;
      for (int k = 0; k < 4; ++k)
        waves.push_back(0.5 + 0.4 * std::cos(M_PI * column / width + 2 * M_PI * k / 4));
      const double decoded = columnFromPatterns(
          stripeOfGrayCode(code), width, waveFromShiftedPatterns(waves).phase);
      ASSERT_NEAR(scanner.range(row, col, decoded - 0.5), range, 1e-9);
    }
  EXPECT_GT(returns, 1000);
}

TEST(ProjectionScanner, SeesNothingInTheShadow)
{
  const ProjectionScanner scanner(smallCamera(), smallProjector(), 9, 1.0 / 60);
  const RangeScan scan = castScan(plateAndWall(), scanner, kIdentity, exactRanges());
  const StripeProjector& projector = *scanner.lightSource();
  int shadow = 0;
  int outside = 0;
  for (int row = 0; row < scan.num_lines; ++row)
    for (int col = 0; col < scan.samples_per_line; ++col) {
      const Eigen::Vector3d d = scanner.ray(row, col).direction;
      const Eigen::Vector3d on_plate = d * (2 / d.x());
      const bool hits_plate =
          std::abs(on_plate.y()) < kPlate && std::abs(on_plate.z()) < kPlate;
      const Eigen::Vector3d p =
          hits_plate ? on_plate : Eigen::Vector3d(d * (5 / d.x()));
      // The way of the light to the wall through the plate's box, 2 to 2.1 m ahead.
      bool is_dark = false;
      for (const double x : {2.0, 2.1}) {
        const Eigen::Vector3d q =
            projector.position() + (p - projector.position()) * (x / p.x());
        is_dark = is_dark ||
                  (!hits_plate && std::abs(q.y()) < kPlate && std::abs(q.z()) < kPlate);
      }
      shadow += is_dark;
      outside += !projector.lights(p);
      ASSERT_EQ(std::isnan(scan.at(row, col).range), is_dark || !projector.lights(p))
          << row << ", " << col;
    }
  EXPECT_GT(shadow, 100);
  EXPECT_GT(outside, 100);
}

TEST(ProjectionScanner, NoiseOfTheColumnGrowsWithTheSquareOfTheRange)
{
  StripeProjectorOptions options = smallProjector();
  options.vergence = 0;
  const CameraIntrinsics camera = smallCamera();
  const ProjectionScanner scanner(camera, options, 9, 1.0 / 60);
  const double sigma = 0.1; // [px] of the projector
  Random random(9);
  const int row = 24;
  const int col = 31; // along the camera's axis
  for (const double range : {1.0, 2.0, 4.0}) {
    const double column =
        scanner.lightSource()->column(range * scanner.ray(row, col).direction);
    double sum_sq = 0;
    const int count = 5000;
    for (int i = 0; i < count; ++i) {
      const double error =
          scanner.range(row, col, column + sigma * random.normal()) - range;
      sum_sq += error * error;
    }
    RangeOptions model = exactRanges();
    model.noise_per_range_sq =
        depthSigmaFromImage(1, options.baseline, options.focal_length, sigma);
    EXPECT_NEAR(std::sqrt(sum_sq / count),
                RangeErrorModel(model).sigma(range, 1, 1),
                0.06 * std::sqrt(sum_sq / count)); // 5 / sqrt(2 N) and second order
  }
}

TEST(ProjectionScanner, KnowsWhereLightAndViewDoNotMeet)
{
  const ProjectionScanner scanner(smallCamera(), smallProjector(), 9, 1.0 / 60);
  EXPECT_TRUE(std::isnan(scanner.range(24, 0, 1e4)));
  EXPECT_TRUE(std::isnan(scanner.range(24, 31, std::nan(""))));
  StripeProjectorOptions options = smallProjector();
  options.vergence = 0;
  const ProjectionScanner parallel(smallCamera(), options, 9, 1.0 / 60);
  EXPECT_TRUE(std::isnan(parallel.range(24, 31, 127.5)));
}

TEST(ProjectionScanner, RefusesBrokenOptions)
{
  const auto refused = [](auto change) {
    StripeProjectorOptions options = smallProjector();
    change(options);
    EXPECT_THROW(StripeProjector{options}, BadArgument);
  };
  refused([](auto& o) { o.baseline = 0; });
  refused([](auto& o) { o.baseline = std::nan(""); });
  refused([](auto& o) { o.vergence = 1; });
  refused([](auto& o) { o.columns = 0; });
  refused([](auto& o) { o.focal_length = 0; });
  refused([](auto& o) { o.height = std::nan(""); });
  EXPECT_THROW(ProjectionScanner(smallCamera(), {}, 0, 1), BadArgument);
  EXPECT_THROW(ProjectionScanner(smallCamera(), {}, 5, std::nan("")), BadArgument);
}
