// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::DrivenScanner;
using pcl6d::DrivenScannerOptions;

constexpr double kTolerance = 1e-14; // a few roundings of numbers of size one

// Range from a point inside a box around the origin to its wall.
double
boxRange(const Eigen::Vector3d& half, const pcl6d::Ray& ray)
{
  double range = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (ray.direction[axis] != 0)
      range =
          std::min(range,
                   (std::copysign(half[axis], ray.direction[axis]) - ray.origin[axis]) /
                       ray.direction[axis]);
  return range;
}

DrivenScannerOptions
fullSphere()
{
  DrivenScannerOptions options = pcl6d::rotatingScanner();
  options.beam = {-M_PI / 2, M_PI / 2, 181};
  return options;
}
} // namespace

TEST(PitchingScanner, FollowsTheClosedForm)
{
  DrivenScannerOptions options = pcl6d::pitchingScanner();
  options.lever_arm = {0.1, 0, 0.05};
  options.axis_position = {0.02, -0.03, 0.4};
  const DrivenScanner scanner(options);
  const double r = 3.7;
  for (int line = 0; line < scanner.numLines(); line += 7)
    for (int i = 0; i < scanner.samplesPerLine(); i += 5) {
      const double theta = options.theta.angle(line);
      const double a = options.beam.angle(i);
      const double ahead = r * std::cos(a) + options.lever_arm.x();
      const Eigen::Vector3d expected =
          options.axis_position +
          Eigen::Vector3d(
              std::cos(theta) * ahead - std::sin(theta) * options.lever_arm.z(),
              r * std::sin(a),
              std::sin(theta) * ahead + std::cos(theta) * options.lever_arm.z());
      const pcl6d::Ray ray = scanner.ray(line, i);
      EXPECT_LT((ray.origin + r * ray.direction - expected).norm(), kTolerance);
      EXPECT_NEAR(ray.direction.norm(), 1, kTolerance);
    }
}

TEST(PitchingScanner, Covers180By120Degrees)
{
  const DrivenScanner scanner(pcl6d::pitchingScanner());
  const double deg = M_PI / 180;
  const int middle = scanner.samplesPerLine() / 2;
  const Eigen::Vector3d low = scanner.ray(0, middle).direction;
  const Eigen::Vector3d high = scanner.ray(scanner.numLines() - 1, middle).direction;
  EXPECT_LT((low - Eigen::Vector3d(std::cos(60 * deg), 0, -std::sin(60 * deg))).norm(),
            kTolerance);
  EXPECT_LT((high - Eigen::Vector3d(std::cos(60 * deg), 0, std::sin(60 * deg))).norm(),
            kTolerance);
  const Eigen::Vector3d right = scanner.ray(17, 0).direction;
  EXPECT_LT((right + Eigen::Vector3d::UnitY()).norm(), kTolerance);
}

TEST(RotatingScanner, PointsToAzimuthAndElevation)
{
  const DrivenScannerOptions options = fullSphere();
  const DrivenScanner scanner(options);
  for (int line = 0; line < scanner.numLines(); line += 7)
    for (int i = 0; i < scanner.samplesPerLine(); i += 5) {
      const double azimuth = options.theta.angle(line);
      const double elevation = options.beam.angle(i);
      const Eigen::Vector3d expected(std::cos(azimuth) * std::cos(elevation),
                                     std::sin(azimuth) * std::cos(elevation),
                                     std::sin(elevation));
      EXPECT_LT((scanner.ray(line, i).direction - expected).norm(), kTolerance);
      EXPECT_EQ(scanner.ray(line, i).origin, Eigen::Vector3d::Zero());
    }
}

TEST(RotatingScanner, SeesNoDirectionTwice)
{
  const DrivenScanner scanner;
  const int last = scanner.numLines() - 1;
  const int middle = scanner.samplesPerLine() / 2;
  const double step = std::acos(
      scanner.ray(0, middle).direction.dot(scanner.ray(last, middle).direction));
  EXPECT_NEAR(step, 2 * M_PI / scanner.numLines(), 1e-9);
}

TEST(RollingScanner, TurnsAboutItsViewingDirection)
{
  DrivenScannerOptions options;
  options.drive = pcl6d::Drive::kRolling;
  options.beam = {-M_PI / 2, M_PI / 2, 5};
  options.theta = {0, M_PI, 9};
  options.mounting = pcl6d::rotationFromEuler({0.1, 0.2, 0.3});
  options.lever_arm = {0, 0.1, 0};
  const DrivenScanner scanner(options);
  for (int line = 0; line < 9; ++line)
    for (int i = 0; i < 5; ++i) {
      const double a = options.beam.angle(i);
      const Eigen::Matrix3d R =
          pcl6d::rotationFromEuler({options.theta.angle(line), 0, 0});
      const pcl6d::Ray ray = scanner.ray(line, i);
      const Eigen::Vector3d beam(std::cos(a), std::sin(a), 0);
      EXPECT_LT((ray.direction - R * options.mounting * beam).norm(), kTolerance);
      EXPECT_LT((ray.origin - R * options.lever_arm).norm(), kTolerance);
    }
}

TEST(DrivenScanner, MeasuresTheAnalyticDistanceToABox)
{
  const Eigen::Vector3d half(4, 3, 1.5);
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, -half, half, {});
  const pcl6d::RayCaster caster(scene);
  pcl6d::RangeOptions options;
  options.noise = 0;
  DrivenScannerOptions pitching = pcl6d::pitchingScanner();
  pitching.lever_arm = {0.1, 0, 0.05};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 0.5, -0.3, 0.2;
  pose.linear() = pcl6d::rotationFromEuler({0.1, -0.2, 2.5});
  for (const auto& scanner_options : {fullSphere(), pitching}) {
    const DrivenScanner scanner(scanner_options);
    const pcl6d::RangeScan scan = castScan(caster, scanner, pose, options);
    for (int line = 0; line < scan.num_lines; ++line)
      for (int i = 0; i < scan.samples_per_line; ++i) {
        const pcl6d::Ray ray = scanner.ray(line, i);
        const double expected =
            boxRange(half, {pose * ray.origin, pose.linear() * ray.direction});
        ASSERT_NEAR(scan.at(line, i).range, expected, 1e-9) << line << ", " << i;
      }
  }
}

TEST(DrivenScanner, RefusesBrokenOptions)
{
  const auto refused = [](auto change) {
    DrivenScannerOptions options = pcl6d::rotatingScanner();
    change(options);
    EXPECT_THROW(DrivenScanner{options}, pcl6d::BadArgument);
  };
  refused([](auto& o) { o.beam.count = 0; });
  refused([](auto& o) { o.line_period = 0; });
  refused([](auto& o) { o.line_period = std::nan(""); });
  refused([](auto& o) { o.sample_period = -1e-6; });
  refused([](auto& o) { o.sample_period = o.line_period / o.beam.count * 1.01; });
  refused([](auto& o) { o.theta.count = 1000000; });
  refused([](auto& o) { o.theta.last = 7; });
  refused([](auto& o) { o.beam.first = std::nan(""); });
  refused([](auto& o) { o.mounting *= 1.01; });
  refused([](auto& o) { o.lever_arm.z() = std::nan(""); });
  refused([](auto& o) { o.axis_position.x() = HUGE_VAL; });
}

TEST(DrivenScanner, TellsWhenASampleIsMeasured)
{
  DrivenScannerOptions options = pcl6d::pitchingScanner();
  const DrivenScanner scanner(options);
  // 75 lines a second; the mirror turns on at constant speed through its blind half.
  EXPECT_EQ(scanner.time(0, 0), 0);
  EXPECT_NEAR(scanner.time(75, 0), 1, 1e-12);
  EXPECT_NEAR(scanner.time(75, 90) - scanner.time(75, 0), 1 / 75.0 / 4, 1e-12);
  EXPECT_NEAR(scanner.duration(), 241 / 75.0, 1e-12);
  options.sample_period = 1e-5;
  EXPECT_NEAR(DrivenScanner(options).time(2, 3), 2 / 75.0 + 3e-5, 1e-12);
}

TEST(DrivenScanner, TurnsOnDuringALineOfAContinuousDrive)
{
  DrivenScannerOptions options = pcl6d::rotatingScanner();
  const DrivenScanner stepped(options);
  options.motion = pcl6d::DriveMotion::kContinuous;
  options.lever_arm = {0.1, 0.02, 0.05};
  const DrivenScanner scanner(options);
  const double speed = options.theta.step() / options.line_period; // [rad/s]
  for (int line = 0; line < scanner.numLines(); line += 17)
    for (int i = 0; i < scanner.samplesPerLine(); i += 7) {
      const double theta = options.theta.first + speed * scanner.time(line, i);
      const double a = options.beam.angle(i);
      const Eigen::Matrix3d R = pcl6d::rotationFromEuler({0, 0, theta});
      const Eigen::Vector3d beam(std::cos(a), 0, std::sin(a));
      EXPECT_LT((scanner.ray(line, i).direction - R * beam).norm(), 1e-13);
      EXPECT_LT((scanner.ray(line, i).origin - R * options.lever_arm).norm(), 1e-13);
    }
  EXPECT_GT((scanner.ray(0, 120).direction - stepped.ray(0, 120).direction).norm(),
            1e-3);
}

TEST(DrivenScanner, TakesMeasuredDriveAngles)
{
  DrivenScannerOptions options = pcl6d::pitchingScanner();
  const std::vector<double> theta = {0.1, 0.3, 0.2};
  const DrivenScanner stepped(options, theta);
  ASSERT_EQ(stepped.numLines(), 3);
  const auto pitched = [](double angle) {
    return Eigen::Vector3d(std::cos(angle), 0, std::sin(angle));
  };
  for (int line = 0; line < 3; ++line)
    EXPECT_LT((stepped.ray(line, 90).direction - pitched(theta[line])).norm(),
              kTolerance);
  // A quarter of the mirror's turn after the line's start; the last line goes on as the
  // one before it.
  options.motion = pcl6d::DriveMotion::kContinuous;
  const DrivenScanner continuous(options, theta);
  const double expected[] = {0.1 + 0.2 / 4, 0.3 - 0.1 / 4, 0.2 - 0.1 / 4};
  for (int line = 0; line < 3; ++line)
    EXPECT_LT((continuous.ray(line, 90).direction - pitched(expected[line])).norm(),
              kTolerance);
  EXPECT_THROW(DrivenScanner(options, {}), pcl6d::BadArgument);
  EXPECT_THROW(DrivenScanner(options, {0, std::nan("")}), pcl6d::BadArgument);
  EXPECT_THROW(DrivenScanner(options, {1e9}), pcl6d::BadArgument);
  EXPECT_EQ(DrivenScanner(options, {0.5}).numLines(), 1);
}
