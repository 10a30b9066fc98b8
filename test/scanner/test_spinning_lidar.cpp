// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/scanner/spinning_lidar.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using pcl6d::SpinningLidar;
using pcl6d::SpinningLidarOptions;
using pcl6d::test::kDegree;

} // namespace

TEST(SpinningLidar, FollowsTheClosedForm)
{
  for (const bool clockwise : {false, true}) {
    SpinningLidarOptions options = pcl6d::vlp16Lidar();
    options.clockwise = clockwise;
    options.first_azimuth = 0.3;
    const SpinningLidar lidar(options);
    for (int line = 0; line < lidar.numLines(); ++line)
      for (int i = 0; i < lidar.samplesPerLine(); i += 37) {
        const double turn =
            2 * M_PI * (i / 1800.0 + options.fire_times[line] / options.turn_period);
        const double a = 0.3 + (clockwise ? -turn : turn);
        const double e = options.elevations[line];
        const Eigen::Vector3d expected(
            std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
        const pcl6d::Ray ray = lidar.ray(line, i);
        ASSERT_LT((ray.direction - expected).norm(), 1e-14);
        ASSERT_EQ(ray.origin, Eigen::Vector3d::Zero());
      }
  }
}

TEST(SpinningLidar, Vlp16FiresItsLasersInOrder)
{
  const SpinningLidarOptions options = pcl6d::vlp16Lidar();
  const SpinningLidar lidar(options);
  ASSERT_EQ(lidar.numLines(), 16);
  std::vector<std::pair<double, double>> shots; // time, elevation [deg]
  for (int line = 0; line < 16; ++line)
    shots.emplace_back(lidar.time(line, 0), options.elevations[line] / kDegree);
  std::sort(shots.begin(), shots.end());
  const double expected[] = {
      -15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(shots[i].second, expected[i], 1e-12);
    EXPECT_NEAR(shots[i].first, i * 2.304e-6, 1e-15);
  }
  EXPECT_NEAR(lidar.time(0, 900) - lidar.time(0, 0), 0.05, 1e-12);
  EXPECT_EQ(lidar.duration(), 0.1);
  EXPECT_LT(lidar.time(0, 1799), lidar.duration());
}

TEST(SpinningLidar, OusterHas64LinesOver45Degrees)
{
  const auto lidar = pcl6d::scannerByName("ouster").scanner;
  ASSERT_EQ(lidar->numLines(), 64);
  ASSERT_EQ(lidar->samplesPerLine(), 1024);
  EXPECT_EQ(lidar->duration(), 0.1);
  EXPECT_NEAR(std::asin(lidar->ray(0, 0).direction.z()), 22.5 * kDegree, 1e-12);
  EXPECT_NEAR(std::asin(lidar->ray(63, 0).direction.z()), -22.5 * kDegree, 1e-12);
  for (const int line : {0, 31, 63}) // a column fires at once
    EXPECT_EQ(lidar->time(line, 512), 0.05);
  EXPECT_EQ(pcl6d::scannerByName("ouster", kDegree).scanner->samplesPerLine(), 360);
}

TEST(SpinningLidar, PresetsHaveTheLinesOfTheirDataSheets)
{
  struct Sheet {
    const char* name;
    int lines, columns;
    double highest, lowest; // [deg]
  };
  for (const Sheet& sheet : {Sheet{"hdl32", 32, 2170, 10.67, -30.67},
                             Sheet{"hdl64", 64, 2083, 2, -24.33},
                             Sheet{"os0", 128, 1024, 45, -45},
                             Sheet{"pandar", 64, 1800, 15, -25},
                             Sheet{"vlp16", 16, 1800, 15, -15}}) {
    SCOPED_TRACE(sheet.name);
    const auto lidar = pcl6d::scannerByName(sheet.name).scanner;
    ASSERT_EQ(lidar->numLines(), sheet.lines);
    EXPECT_EQ(lidar->samplesPerLine(), sheet.columns);
    EXPECT_NEAR(lidar->duration(), 0.1, 0.001);
    double above = 90 * kDegree;
    for (int line = 0; line < sheet.lines; ++line) {
      const double elevation = std::asin(lidar->ray(line, 0).direction.z());
      EXPECT_LT(elevation, above) << "line " << line;
      above = elevation;
    }
    EXPECT_NEAR(
        std::asin(lidar->ray(0, 0).direction.z()), sheet.highest * kDegree, 1e-9);
    EXPECT_NEAR(above, sheet.lowest * kDegree, 0.1 * kDegree);
  }
}

TEST(SpinningLidar, RefusesBrokenOptions)
{
  const auto refused = [](auto change) {
    SpinningLidarOptions options = pcl6d::vlp16Lidar();
    change(options);
    EXPECT_THROW(SpinningLidar{options}, pcl6d::BadArgument);
  };
  refused([](auto& o) { o.elevations.clear(); });
  refused([](auto& o) { o.elevations[3] = 2; });
  refused([](auto& o) { o.elevations[3] = std::nan(""); });
  refused([](auto& o) { o.fire_times.pop_back(); });
  refused([](auto& o) { o.fire_times[2] = -1e-6; });
  refused([](auto& o) { o.fire_times[2] = 0.1 / 1800; });
  refused([](auto& o) { o.columns = 0; });
  refused([](auto& o) { o.columns = 100000000; });
  refused([](auto& o) { o.turn_period = 0; });
  refused([](auto& o) { o.turn_period = HUGE_VAL; });
  refused([](auto& o) { o.first_azimuth = std::nan(""); });
}
