// SPDX-License-Identifier: BSD-3-Clause
#include "scanner/expect_refused.h"
#include "support/constants.h"

#include <pcl6d/scanner/driven_scanner_projection.h>

#include <Eigen/Geometry>

namespace {
using Eigen::Vector3d;
using pcl6d::Drive;
using pcl6d::DrivenScannerOptions;
using pcl6d::DrivenScannerProjection;
using pcl6d::Pixel;
using pcl6d::test::expectRefused;
using pcl6d::test::kDegree;

// Scanners of all drives, each with a lever arm, so that nothing cancels.
std::vector<DrivenScannerOptions>
allDrives()
{
  std::vector<DrivenScannerOptions> all(3);
  all[0] = pcl6d::pitchingScanner();
  all[0].beam = {-88 * kDegree, 89 * kDegree, 178}; // not along the axis itself
  all[1].drive = Drive::kRolling;
  all[1].beam = {-80 * kDegree, 80 * kDegree, 160}; // no sample straight ahead
  all[1].theta = {-90 * kDegree, 88 * kDegree, 90};
  all[2] = pcl6d::rotatingScanner();
  all[2].lever_arm = {0.05, 0.02, -0.1};
  all[2].axis_position = {0.2, 0.1, 0.3};
  all[0].lever_arm = {0.04, 0, 0.1};
  all[0].axis_position = {-0.1, 0, 0.6};
  all[1].axis_position = {0.1, -0.2, 0.3};
  return all;
}
} // namespace

TEST(DrivenScannerProjection, FindsTheBeamThatSawAPoint)
{
  for (const auto& options : allDrives()) {
    const DrivenScannerProjection projection(options);
    ASSERT_EQ(projection.rows(), options.theta.count);
    ASSERT_EQ(projection.cols(), options.beam.count);
    for (int row = 0; row < projection.rows(); ++row)
      for (int col = 0; col < projection.cols(); ++col) {
        const pcl6d::Ray ray = projection.ray({row, col});
        const auto seen = projection.project(ray.origin + 5 * ray.direction);
        ASSERT_TRUE(seen) << row << ' ' << col;
        EXPECT_EQ(seen->pixel, (Pixel{row, col}))
            << seen->pixel.row << ' ' << seen->pixel.col;
        EXPECT_NEAR(seen->range, 5, 1e-12);
      }
  }
}

TEST(DrivenScannerProjection, FollowsADriveThatTurnsOnDuringALine)
{
  for (auto options : allDrives()) {
    options.motion = pcl6d::DriveMotion::kContinuous;
    const DrivenScannerProjection projection(options);
    for (int row = 0; row < projection.rows(); row += 7)
      for (int col = 0; col < projection.cols(); ++col) {
        const pcl6d::Ray ray = projection.ray({row, col});
        const auto seen = projection.project(ray.origin + 5 * ray.direction);
        ASSERT_TRUE(seen) << row << ' ' << col;
        EXPECT_EQ(seen->pixel, (Pixel{row, col}))
            << seen->pixel.row << ' ' << seen->pixel.col;
      }
  }
}

TEST(DrivenScannerProjection, SeesHalfAStepToEachSide)
{
  const auto options = pcl6d::pitchingScanner(); // 1 deg by 0.5 deg
  const DrivenScannerProjection projection(options);
  const auto at = [&](double theta, double alpha) {
    return projection.project(
        Vector3d(std::cos(theta * kDegree) * std::cos(alpha * kDegree),
                 std::sin(alpha * kDegree),
                 std::sin(theta * kDegree) * std::cos(alpha * kDegree)));
  };
  EXPECT_EQ(at(10.24, 20.49)->pixel, (Pixel{140, 110}));
  EXPECT_EQ(at(10.26, 20.51)->pixel, (Pixel{141, 111}));
  EXPECT_TRUE(at(60.24, 0));
  EXPECT_FALSE(at(60.26, 0)) << "above the last line";
  EXPECT_FALSE(at(180, 0)) << "behind";
}

TEST(DrivenScannerProjection, GivesTheAxisToTheFirstLine)
{
  auto options = pcl6d::pitchingScanner();
  options.motion = pcl6d::DriveMotion::kContinuous;
  EXPECT_EQ(DrivenScannerProjection(options).project({0, 3, 0})->pixel,
            (Pixel{0, 180}));
  const DrivenScannerProjection projection(pcl6d::pitchingScanner());
  EXPECT_EQ(projection.project({0, -3, 0})->pixel, (Pixel{0, 0}));
  EXPECT_EQ(projection.project({0, 3, 0})->pixel, (Pixel{0, 180}));
  EXPECT_EQ(projection.project({1e-12, 3, -1e-12})->pixel, (Pixel{0, 180}));
}

TEST(DrivenScannerProjection, SeesNothingWithinItsLeverArm)
{
  auto options = pcl6d::pitchingScanner();
  options.lever_arm = {0, 0, 0.5};
  const DrivenScannerProjection projection(options);
  EXPECT_FALSE(projection.project({0.1, 0, 0}));
  EXPECT_TRUE(projection.project({1, 0, 0.3}));
  EXPECT_FALSE(projection.project(Vector3d::Constant(NAN)));
  EXPECT_FALSE(projection.project(Vector3d::Zero()));
}

TEST(DrivenScannerProjection, NeedsAFan)
{
  auto options = pcl6d::pitchingScanner();
  options.theta.count = 1;
  expectRefused([&] { DrivenScannerProjection projection(options); },
                "theta.count = 1");
  options = pcl6d::pitchingScanner();
  options.beam.last = options.beam.first;
  expectRefused([&] { DrivenScannerProjection projection(options); },
                "beam.count = 181");
  options = pcl6d::pitchingScanner();
  options.theta.count = options.beam.count = 99999;
  expectRefused([&] { DrivenScannerProjection projection(options); }, " GB");
}
