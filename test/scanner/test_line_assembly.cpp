// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/scanner/line_assembly.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using namespace pcl6d;

DrivenScannerOptions
tiltedFan()
{
  DrivenScannerOptions options;
  options.drive = Drive::kPitching;
  options.motion = DriveMotion::kContinuous;
  options.beam = {-1, 1, 21};
  options.theta = {-0.5, 0.5, 31};
  options.lever_arm = {0.1, 0, 0.05};
  options.axis_position = {0, 0.02, 0.3};
  return options;
}

// What the devices of a scanner deliver of a room.
RangeLines
linesOf(const DrivenScannerOptions& options)
{
  TriangleScene scene;
  addBox(scene, {-4, -3, -1.5}, {4, 3, 2}, {"room", 0.8});
  const DrivenScanner scanner(options);
  const RangeScan scan = castScan(RayCaster(scene),
                                  scanner,
                                  Eigen::Isometry3d::Identity(),
                                  RangeOptions().withoutErrors());
  RangeLines lines;
  lines.samples_per_line = static_cast<std::size_t>(scan.samples_per_line);
  for (int line = 0; line < scan.num_lines; ++line) {
    lines.angles.push_back(options.theta.angle(line));
    lines.times.push_back(100 + scanner.time(line, 0));
  }
  for (const auto& sample : scan.samples)
    lines.ranges.push_back(sample.range);
  return lines;
}
} // namespace

TEST(LineAssembly, GivesBackTheRoomThatWasScanned)
{
  for (const auto drive : {Drive::kPitching, Drive::kRolling, Drive::kYawing}) {
    LineAssemblyOptions options;
    options.scanner = tiltedFan();
    options.scanner.drive = drive;
    const LineAssembly assembly(linesOf(options.scanner), options);
    const auto cloud = assembly.cloud();
    ASSERT_EQ(cloud.height, 31u);
    ASSERT_EQ(cloud.width, 21u);
    EXPECT_TRUE(cloud.is_dense);
    for (int line = 0; line < 31; ++line)
      for (int i = 0; i < 21; ++i) {
        const Ray ray = assembly.scanner().ray(line, i);
        const Eigen::Vector3d p =
            ray.origin + assembly.scan().at(line, i).range * ray.direction;
        const Eigen::Vector3d inside =
            (Eigen::Vector3d(4, 3, 2) - p).cwiseMin(p + Eigen::Vector3d(4, 3, 1.5));
        ASSERT_NEAR(inside.minCoeff(), 0, 1e-9);
        ASSERT_LT((cloud(i, line).getVector3fMap().cast<double>() - p).norm(), 1e-6);
      }
  }
}

TEST(LineAssembly, TellsTimesSinceTheFirstLine)
{
  LineAssemblyOptions options;
  options.scanner = tiltedFan();
  const DrivenScanner original(options.scanner);
  const RangeLines lines = linesOf(options.scanner);
  const LineAssembly assembly(lines, options);
  for (int line = 0; line < 31; line += 3)
    for (int i = 0; i < 21; i += 5)
      EXPECT_NEAR(assembly.scanner().time(line, i), original.time(line, i), 1e-12);
  EXPECT_NEAR(assembly.scanner().duration(), original.duration(), 1e-12);
}

TEST(LineAssembly, MakesNaNOfWhatDidNotReturn)
{
  RangeLines lines;
  lines.angles = {0, 0.1};
  lines.samples_per_line = 3;
  lines.ranges = {1, 0, std::nan(""), HUGE_VAL, 0.05, 9};
  LineAssemblyOptions options;
  options.scanner.beam = {-1, 1, 3};
  options.min_range = 0.1;
  options.max_range = 8;
  const auto cloud = LineAssembly(lines, options).cloud();
  EXPECT_FALSE(cloud.is_dense);
  EXPECT_TRUE(std::isfinite(cloud[0].x));
  for (std::size_t i = 1; i < 6; ++i)
    EXPECT_TRUE(std::isnan(cloud[i].x) && std::isnan(cloud[i].y) &&
                std::isnan(cloud[i].z))
        << i;
}

TEST(LineAssembly, RefusesWhatDoesNotFit)
{
  const auto refused = [](auto change) {
    LineAssemblyOptions options;
    options.scanner = tiltedFan();
    RangeLines lines = linesOf(options.scanner);
    change(lines, options);
    EXPECT_THROW(LineAssembly(lines, options), BadArgument);
  };
  refused([](auto& lines, auto&) { lines.angles.pop_back(); });
  refused([](auto& lines, auto&) { lines.times.pop_back(); });
  refused([](auto& lines, auto&) { lines.times[3] = lines.times[2]; });
  refused([](auto& lines, auto&) { lines.times[3] = std::nan(""); });
  refused([](auto& lines, auto&) { lines.angles[3] = std::nan(""); });
  refused([](auto& lines, auto&) { lines.samples_per_line = 20; });
  refused([](auto& lines, auto&) { lines = {}; });
  refused([](auto&, auto& options) { options.min_range = std::nan(""); });
  refused([](auto&, auto& options) { options.max_range = 0; });
  refused([](auto&, auto& options) { options.scanner.mounting *= 2; });
}
