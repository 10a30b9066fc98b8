// SPDX-License-Identifier: BSD-3-Clause
#include "small_camera.h"
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>
#include <pcl6d/scanner/measurement_principles.h>
#include <pcl6d/scanner/tof_camera.h>
#include <pcl6d/simulation/cast_scan.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;
using pcl6d::test::exactRanges;
using pcl6d::test::kIdentity;
using pcl6d::test::plateAndWall;
using pcl6d::test::smallCamera;

TofCamera
tofCamera()
{
  return TofCamera(smallCamera(), 20e6, 0.04);
}

// What the chip samples: offset 3, swing A, noise sigma.
std::array<std::vector<double>, 4>
imagesOf(const RangeScan& scan, double amplitude, double sigma)
{
  Random random(2);
  std::array<std::vector<double>, 4> images;
  for (int k = 0; k < 4; ++k)
    for (const auto& sample : scan.samples)
      images[k].push_back(
          3 + amplitude * std::cos(phaseOfRange(sample.range, 20e6) + k * M_PI / 2) +
          sigma * random.normal());
  return images;
}

} // namespace

TEST(CameraScanner, FollowsTheClosedForm)
{
  const CameraIntrinsics camera = smallCamera();
  const CameraScanner scanner(camera, 0.04);
  ASSERT_EQ(scanner.numLines(), 48);
  ASSERT_EQ(scanner.samplesPerLine(), 64);
  for (int row = 0; row < 48; ++row)
    for (int col = 0; col < 64; ++col) {
      const double x = (col - camera.cx) / camera.fx;
      const double y = (row - camera.cy) / camera.fy;
      const Eigen::Vector3d expected = Eigen::Vector3d(1, -x, -y).normalized();
      ASSERT_LT((scanner.ray(row, col).direction - expected).norm(), 1e-14);
      ASSERT_EQ(scanner.ray(row, col).origin, Eigen::Vector3d::Zero());
      ASSERT_EQ(scanner.time(row, col), 0);
    }
  EXPECT_EQ(scanner.duration(), 0.04);
}

TEST(CameraScanner, LooksThroughADistortingLens)
{
  CameraIntrinsics camera = smallCamera();
  camera.k = {-0.2, 0.05, 0, 0, 0, 0};
  camera.p = {1e-3, -2e-3};
  const CameraScanner scanner(camera, 0.04);
  const PinholeCamera lens(camera);
  for (int row = 0; row < 48; row += 3)
    for (int col = 0; col < 64; col += 3) {
      const Eigen::Vector3d d = scanner.ray(row, col).direction;
      const auto pixel = lens.project({-d.y(), -d.z(), d.x()});
      ASSERT_TRUE(pixel);
      ASSERT_LT((*pixel - Eigen::Vector2d(col, row)).norm(), 1e-9);
    }
}

TEST(CameraScanner, RefusesBrokenOptions)
{
  const auto refused = [](auto change, double period = 0.04) {
    CameraIntrinsics camera = smallCamera();
    change(camera);
    EXPECT_THROW(CameraScanner(camera, period), BadArgument);
  };
  refused([](auto& c) { c.width = 0; });
  refused([](auto& c) { c.height = -3; });
  refused([](auto& c) { c.width = c.height = 1000000; });
  refused([](auto& c) { c.fx = std::nan(""); });
  refused([](auto& c) { c.k[0] = -3; }); // bends back within the image
  refused([](auto&) {}, 0);
  refused([](auto&) {}, std::nan(""));
}

TEST(CameraScanner, StatesTheMemoryOfAnAbsurdImage)
{
  CameraIntrinsics camera = smallCamera();
  camera.width = camera.height = 1000000;
  try {
    CameraScanner(camera, 1);
    FAIL();
  } catch (const BadArgument& e) {
    EXPECT_NE(std::string(e.what()).find("5.6e+04 GB"), std::string::npos) << e.what();
  }
}

TEST(TofCamera, FindsRangesFromFourImages)
{
  const TofCamera camera = tofCamera();
  const RangeScan truth = castScan(plateAndWall(), camera, kIdentity, exactRanges());
  const RangeScan found = camera.rangeScan(imagesOf(truth, 0.8, 0));
  for (std::size_t i = 0; i < truth.samples.size(); ++i) {
    ASSERT_NEAR(found.samples[i].range, truth.samples[i].range, 1e-12);
    ASSERT_NEAR(found.samples[i].intensity, 0.8, 1e-12);
  }
}

TEST(TofCamera, NoiseOfTheSamplesBecomesNoiseOfTheRange)
{
  const TofCamera camera = tofCamera();
  const RangeScan truth = castScan(plateAndWall(), camera, kIdentity, exactRanges());
  const RangeScan found = camera.rangeScan(imagesOf(truth, 1, 0.02));
  double sum = 0;
  double sum_sq = 0;
  const auto count = static_cast<double>(truth.samples.size());
  for (std::size_t i = 0; i < truth.samples.size(); ++i) {
    const double error = found.samples[i].range - truth.samples[i].range;
    sum += error;
    sum_sq += error * error;
  }
  // First order: sigma_phi = sigma / (sqrt(2) A).
  const double sigma = rangeSigmaFromPhase(0.02 / std::sqrt(2.0), 20e6);
  EXPECT_NEAR(sum / count, 0, 5 * sigma / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_sq / count), sigma, 5 * sigma / std::sqrt(2 * count));
}

TEST(TofCamera, GatesDarkAndSaturatedPixels)
{
  const TofCamera camera = tofCamera();
  const RangeScan truth = castScan(plateAndWall(), camera, kIdentity, exactRanges());
  const auto images = imagesOf(truth, 0.8, 0);
  TofGate gate;
  gate.min_amplitude = 0.81;
  EXPECT_TRUE(std::isnan(camera.rangeScan(images, gate).samples[7].range));
  gate = {};
  gate.max_offset = 2.9;
  EXPECT_TRUE(std::isnan(camera.rangeScan(images, gate).samples[7].range));
  gate.max_offset = 3.1;
  EXPECT_FALSE(std::isnan(camera.rangeScan(images, gate).samples[7].range));
  gate.max_jump = 0;
  EXPECT_THROW(camera.rangeScan(images, gate), BadArgument);
  auto short_image = images;
  short_image[2].pop_back();
  EXPECT_THROW(camera.rangeScan(short_image), BadArgument);
  auto dark = images;
  for (auto& image : dark)
    image[5] = 1;
  EXPECT_TRUE(std::isnan(camera.rangeScan(dark).samples[5].range));
}

TEST(TofCamera, DropsFlyingPixelsAndNothingElse)
{
  const TofCamera camera = tofCamera();
  const RayCaster scene = plateAndWall();
  RangeOptions options = exactRanges();
  options.beam.divergence = 1 / smallCamera().fx; // the spot fills a pixel
  options.beam.rays = 50;
  RangeScan scan = castScan(scene, camera, kIdentity, options);
  const auto isBetween = [&camera](const RangeScan& s, int row, int col) {
    const double depth = s.at(row, col).range * camera.ray(row, col).direction.x();
    return depth > 2.06 && depth < 4.94;
  };
  constexpr double kJump = 0.05; // [m] more than a slanted surface has
  int flying = 0;
  for (int row = 0; row < scan.num_lines; ++row)
    for (int col = 0; col < scan.samples_per_line; ++col)
      flying += isBetween(scan, row, col);
  ASSERT_GE(flying, 40);
  const RangeScan before = scan;
  const std::size_t dropped = dropFlyingPixels(scan, kJump);
  int left = 0;
  int wrong = 0;
  for (int row = 0; row < scan.num_lines; ++row)
    for (int col = 0; col < scan.samples_per_line; ++col) {
      left += isBetween(scan, row, col);
      wrong += std::isnan(scan.at(row, col).range) && !isBetween(before, row, col);
    }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(left, flying / 10);
  EXPECT_GE(dropped, static_cast<std::size_t>(flying - left));
}
