// SPDX-License-Identifier: BSD-3-Clause
#include "body_checks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/simulation/traffic.h>
#include <pcl6d/simulation/truth_fields.h>

#include <pcl/conversions.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::BadArgument;
using pcl6d::SimulationOptions;
using pcl6d::SimulationScene;
using pcl6d::Simulator;
using pcl6d::TrafficOptions;

SimulationOptions
exactDrive(int num_scans)
{
  SimulationOptions options;
  options.num_scans = num_scans;
  options.range.noise = 0;
  return options;
}

SimulationScene
withTraffic(const std::string& name,
            const TrafficOptions& traffic,
            const SimulationOptions& options)
{
  SimulationScene scene = pcl6d::builtInScene(name);
  pcl6d::addTraffic(scene, Simulator(scene, options), traffic);
  return scene;
}
} // namespace

TEST(Traffic, PeopleInTheCorridorNeverWalkThroughThings)
{
  const auto options = exactDrive(20);
  TrafficOptions traffic;
  traffic.people = 4;
  const SimulationScene scene = withTraffic("corridor", traffic, options);
  ASSERT_EQ(scene.moving.size(), 4u);
  const Simulator simulator(scene, options);
  const double end = simulator.truth().stamps.back() + simulator.scanner().duration();
  for (const auto& body : scene.moving) {
    EXPECT_GE(body.times.back(), end);
    for (double time = 0; time < end; time += 1.3) {
      // Ramps rise by 10 %: 0.03 m at the edge of a shoe.
      EXPECT_EQ(
          pcl6d::test::cutBy(body.shape, body.poseAt(time), simulator.caster(), 0.05),
          "")
          << time;
      EXPECT_GT((body.poseAt(time).translation() - simulator.poseAt(time).translation())
                    .head<2>()
                    .norm(),
                1.0)
          << time;
    }
  }
}

TEST(Traffic, CarsInTheCarParkDriveOnItsLanes)
{
  const auto options = exactDrive(12);
  TrafficOptions traffic;
  traffic.cars = 2;
  traffic.people = 1;
  const SimulationScene scene = withTraffic("parking", traffic, options);
  ASSERT_EQ(scene.moving.size(), 3u);
  EXPECT_EQ(scene.moving[0].name, "car");
  EXPECT_EQ(scene.moving[2].name, "person");
  const Simulator simulator(scene, options);
  for (const auto& body : scene.moving)
    for (double time = 0; time < body.times.back(); time += 1.7)
      EXPECT_EQ(
          pcl6d::test::cutBy(body.shape, body.poseAt(time), simulator.caster(), 0.05),
          "")
          << body.name << ' ' << time;
}

// Each label is the truth, and bodies change nothing but what they hide.
TEST(Traffic, DynamicIsExact)
{
  const auto options = exactDrive(8);
  TrafficOptions traffic;
  traffic.people = 4;
  const SimulationScene scene = withTraffic("corridor", traffic, options);
  const Simulator busy(scene, options);
  const Simulator empty(pcl6d::builtInScene("corridor"), options);
  std::size_t moving = 0;
  for (std::size_t i = 0; i < busy.size(); ++i) {
    EXPECT_EQ(busy.truth().poses[i].matrix(), empty.truth().poses[i].matrix());
    const auto scan = busy.rangeScan(i);
    const auto before = empty.rangeScan(i);
    const auto points = busy.scan(i);
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(points, cloud);
    const std::size_t labelled = pcl6d::addDynamicField(cloud, scan, busy.scene());
    const auto dynamic = pcl6d::fieldValues(cloud, "dynamic");
    ASSERT_TRUE(dynamic && dynamic->is_integer);
    std::size_t ones = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double was = before.samples[k].range;
      if (dynamic->values[k] == 0) {
        ASSERT_TRUE(scan.samples[k].range == was ||
                    (std::isnan(was) && std::isnan(scan.samples[k].range)));
        continue;
      }
      ++ones;
      ASSERT_FALSE(was < scan.samples[k].range);
      if (ones % 40 > 0)
        continue;
      const auto per_line = static_cast<std::size_t>(scan.samples_per_line);
      const double time =
          busy.truth().stamps[i] + busy.scanner().time(static_cast<int>(k / per_line),
                                                       static_cast<int>(k % per_line));
      const Eigen::Vector3d p = busy.sceneFromWorld() * busy.truth().poses[i] *
                                points[k].getVector3fMap().cast<double>();
      double least = 1;
      for (const auto& body : scene.moving)
        least = std::min(
            least,
            pcl6d::test::distanceTo(body.shape, body.poseAt(time).inverse() * p));
      EXPECT_LT(least, 5e-6) << "float, below 32 m";
    }
    EXPECT_EQ(ones, labelled);
    moving += ones;
  }
  EXPECT_GT(moving, 500u);
}

TEST(Traffic, WhoNeverMovesIsNotDynamic)
{
  SimulationScene scene = pcl6d::builtInScene("crowd");
  for (auto& body : scene.moving)
    body.speed = 0;
  const Simulator simulator(scene, exactDrive(2));
  const auto scan = simulator.rangeScan(0);
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(simulator.scan(0), cloud);
  EXPECT_EQ(pcl6d::addDynamicField(cloud, scan, simulator.scene()), 0u);
  EXPECT_THROW(pcl6d::addDynamicField(cloud, scan, simulator.scene()), BadArgument)
      << "there is such a field";
}

TEST(Traffic, RefusesCountsThatCannotBe)
{
  SimulationScene scene = pcl6d::builtInScene("corridor");
  const Simulator drive(scene, exactDrive(2));
  for (const int count : {-1, 201}) {
    TrafficOptions traffic;
    traffic.people = count;
    EXPECT_THROW(pcl6d::addTraffic(scene, drive, traffic), BadArgument);
    traffic.people = 0;
    traffic.cars = count;
    EXPECT_THROW(pcl6d::addTraffic(scene, drive, traffic), BadArgument);
  }
  TrafficOptions traffic;
  pcl6d::addTraffic(scene, drive, traffic);
  EXPECT_TRUE(scene.moving.empty());
  traffic.cars =
      1; // no car fits through these doors, and rooms are too small to drive in
  EXPECT_THROW(pcl6d::addTraffic(scene, drive, traffic), pcl6d::ComputeFailed);
}
