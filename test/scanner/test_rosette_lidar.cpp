// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scanner/rosette_lidar.h>
#include <pcl6d/scanner/scanner_presets.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace {
using pcl6d::RosetteLidar;
using pcl6d::RosetteLidarOptions;
using pcl6d::RosetteShape;
using pcl6d::test::kDegree;

double
elevationOf(const Eigen::Vector3d& direction)
{
  return std::asin(direction.z());
}
} // namespace

TEST(RosetteLidar, DiscFollowsTheClosedForm)
{
  RosetteLidarOptions options;
  options.lasers = 3;
  options.samples = 1000;
  options.lowest = -0.4;
  options.highest = 0.6;
  const RosetteLidar lidar(options);
  EXPECT_EQ(lidar.numLines(), 3);
  EXPECT_EQ(lidar.samplesPerLine(), 1000);
  for (int line = 0; line < 3; ++line)
    for (int i = 0; i < 1000; i += 7) {
      const double t = 0.1 * i / 1000, phase = 2 * M_PI * line / 3;
      const double a = 2 * M_PI * options.first_rate * t + phase;
      const double b = 2 * M_PI * options.second_rate * t + phase;
      const double left = options.half_width * (std::sin(a) + std::sin(b)) / 2;
      const double up = 0.1 + 0.5 * (std::cos(a) + std::cos(b)) / 2;
      const pcl6d::Ray ray = lidar.ray(line, i);
      const double off = std::hypot(left, up);
      ASSERT_NEAR(std::acos(ray.direction.x()), off, 1e-7);
      ASSERT_NEAR(ray.direction.y() * up, ray.direction.z() * left, 1e-12);
      ASSERT_NEAR(ray.direction.norm(), 1, 1e-14);
      ASSERT_EQ(ray.origin, Eigen::Vector3d::Zero());
      ASSERT_EQ(lidar.time(line, i), t);
    }
}

TEST(RosetteLidar, DiscFillsItsEllipseAndPassesItsMiddle)
{
  RosetteLidarOptions options;
  options.half_width = 0.7;
  const RosetteLidar lidar(options);
  double nearest = 1, widest = 0, highest = 0;
  std::set<std::pair<int, int>> cells; // of 0.07 rad
  for (int i = 0; i < lidar.samplesPerLine(); ++i) {
    const Eigen::Vector3d d = lidar.ray(0, i).direction;
    const double off = std::acos(std::min(1.0, d.x()));
    const double scale = off > 0 ? off / std::sin(off) : 1;
    const double left = scale * d.y() / 0.7, up = scale * d.z() / 0.6;
    ASSERT_LE(std::hypot(left, up), 1 + 1e-9);
    nearest = std::min(nearest, std::hypot(left, up));
    widest = std::max(widest, std::abs(left));
    highest = std::max(highest, std::abs(up));
    cells.emplace(std::lround(10 * left), std::lround(10 * up));
  }
  EXPECT_LT(nearest, 0.02);
  EXPECT_GT(widest, 0.97);
  EXPECT_GT(highest, 0.97);
  EXPECT_GT(cells.size(), 270u) << "of about 314 in the disc";
}

TEST(RosetteLidar, CurvesOfAScanDoNotClose)
{
  const RosetteLidar lidar{RosetteLidarOptions()};
  const Eigen::Vector3d first = lidar.ray(0, 0).direction;
  std::size_t again = 0;
  for (int i = 100; i < lidar.samplesPerLine(); ++i)
    again += (lidar.ray(0, i).direction - first).norm() < 1e-4 ? 1 : 0;
  EXPECT_EQ(again, 0u);
}

TEST(RosetteLidar, BeltGoesAllAround)
{
  RosetteLidarOptions options;
  options.shape = RosetteShape::kBelt;
  options.first_rate = 13.1;
  options.second_rate = 401.3;
  options.lowest = -7 * kDegree;
  options.highest = 52 * kDegree;
  options.lasers = 4;
  options.samples = 5000;
  options.half_width = 0; // a belt has none
  const RosetteLidar lidar(options);
  double lowest = 2, highest = -2;
  std::set<std::pair<int, int>> cells; // of 10 degrees of azimuth and elevation
  for (int line = 0; line < 4; ++line)
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d d = lidar.ray(line, i).direction;
      lowest = std::min(lowest, elevationOf(d));
      highest = std::max(highest, elevationOf(d));
      cells.emplace(std::floor(std::atan2(d.y(), d.x()) / (10 * kDegree)),
                    std::floor((elevationOf(d) + 7 * kDegree + 1e-9) / (10 * kDegree)));
    }
  EXPECT_NEAR(lowest, -7 * kDegree, 1e-6);
  EXPECT_NEAR(highest, 52 * kDegree, 1e-4);
  EXPECT_GE(cells.size(), 36u * 6u);
}

TEST(RosetteLidar, PresetsHaveTheFieldOfTheirDataSheets)
{
  const auto avia = pcl6d::scannerByName("avia"), mid = pcl6d::scannerByName("mid360");
  EXPECT_EQ(avia.scanner->numLines() * avia.scanner->samplesPerLine(), 24000);
  EXPECT_EQ(mid.scanner->numLines() * mid.scanner->samplesPerLine(), 20000);
  double widest = 0, highest = 0;
  for (int line = 0; line < avia.scanner->numLines(); ++line)
    for (int i = 0; i < avia.scanner->samplesPerLine(); ++i) {
      const Eigen::Vector3d d = avia.scanner->ray(line, i).direction;
      widest = std::max(widest, std::abs(std::atan2(d.y(), d.x())));
      highest = std::max(highest, std::abs(elevationOf(d)));
    }
  EXPECT_NEAR(widest, 35.2 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(highest, 38.6 * kDegree, 0.5 * kDegree);
}

TEST(RosetteLidar, AtHalfTheResolutionAQuarterOfThePointsRemain)
{
  for (const auto& [name, step] :
       {std::pair("avia", 0.42 * kDegree), std::pair("mid360", 0.97 * kDegree)}) {
    const auto own = pcl6d::scannerByName(name).scanner;
    const auto same = pcl6d::scannerByName(name, step).scanner;
    const auto coarse = pcl6d::scannerByName(name, 2 * step).scanner;
    const auto fine = pcl6d::scannerByName(name, step / 2).scanner;
    EXPECT_NEAR(same->samplesPerLine(), own->samplesPerLine(), 100) << name;
    EXPECT_NEAR(4.0 * coarse->samplesPerLine(), same->samplesPerLine(), 4);
    EXPECT_NEAR(fine->samplesPerLine() / 4.0, same->samplesPerLine(), 4);
    EXPECT_EQ(coarse->duration(), own->duration());
    EXPECT_NEAR(fine->duration(), 0.4, 0.02) << "lasers keep their pace";
  }
}

TEST(RosetteLidar, RefusesWhatBreaksARule)
{
  const auto refused = [](auto change) {
    RosetteLidarOptions options;
    change(options);
    try {
      const RosetteLidar lidar(options);
      return std::string();
    } catch (const pcl6d::BadArgument& error) {
      return std::string(error.what());
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused([](auto& o) { o.first_rate = 0; }).find("first_rate"),
            std::string::npos);
  EXPECT_NE(refused([&](auto& o) { o.second_rate = nan; }).find("second_rate"),
            std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.half_width = 0; }).find("half_width"),
            std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.lowest = -2; }).find("lowest"), std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.highest = -1; }).find("highest"),
            std::string::npos);
  EXPECT_NE(refused([&](auto& o) { o.scan_period = nan; }).find("scan_period"),
            std::string::npos);
  EXPECT_NE(refused([](auto& o) { o.lasers = 0; }), "");
  EXPECT_NE(refused([](auto& o) { o.samples = 0; }), "");
}
