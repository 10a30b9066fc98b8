// SPDX-License-Identifier: BSD-3-Clause
#include "exact_drive.h"

#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using pcl6d::builtInScene;
using pcl6d::SimulationOptions;
using pcl6d::SimulationScene;
using pcl6d::Simulator;
using pcl6d::test::exactDrive;

// In plan, from a place to a leg of a way.
double
distanceToLeg(const Eigen::Vector2d& p,
              const Eigen::Vector2d& a,
              const Eigen::Vector2d& b)
{
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

// Of a body, wherever it may be, to the robot, wherever it may be.
double
leastDistance(const pcl6d::MovingBody& body, const Simulator& simulator)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& pose : simulator.truth().poses) {
    const Eigen::Vector2d robot =
        (simulator.sceneFromWorld() * pose).translation().head<2>();
    for (std::size_t i = 0; i < body.way.size(); ++i)
      least = std::min(least,
                       distanceToLeg(robot,
                                     body.way[i].head<2>(),
                                     body.way[(i + 1) % body.way.size()].head<2>()));
  }
  return least;
}
} // namespace

TEST(CrowdScene, HasPeopleAndCarsThatMoveBesideTheRobotsWay)
{
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SimulationScene scene = builtInScene("crowd", seed);
    SimulationOptions options = exactDrive(scene);
    options.num_scans = 400; // finely enough for the distances below
    const Simulator simulator(scene, options);
    int people = 0;
    int cars = 0;
    for (const auto& body : scene.moving) {
      people += body.name == "person";
      cars += body.name == "car";
      EXPECT_GT(leastDistance(body, simulator), 1.2) << body.name;
      // From scan to scan of a drive by default.
      EXPECT_GT((body.poseAt(7).translation() - body.poseAt(0).translation()).norm(),
                0.1);
    }
    EXPECT_EQ(people, 19);
    EXPECT_EQ(cars, 4);
    EXPECT_EQ(std::count_if(scene.objects.begin(),
                            scene.objects.end(),
                            [](const auto& object) { return object.moves; }),
              people + cars);
  }
}

TEST(CrowdScene, HasTheSameTruthWithAndWithoutThem)
{
  const SimulationScene scene = builtInScene("crowd");
  SimulationScene still = scene;
  still.moving.clear();
  const Simulator crowded(scene, exactDrive(scene));
  const Simulator empty(still, exactDrive(scene));
  const std::size_t ground = scene.geometry.triangles.size();
  std::size_t on_bodies = 0;
  for (std::size_t i = 0; i < crowded.size(); ++i) {
    EXPECT_EQ(crowded.truth().poses[i].matrix(), empty.truth().poses[i].matrix());
    EXPECT_EQ(crowded.odometry().poses[i].matrix(), empty.odometry().poses[i].matrix());
    if (i % 10 > 0)
      continue;
    const auto scan = crowded.rangeScan(i);
    const auto expected = empty.rangeScan(i);
    for (std::size_t k = 0; k < scan.samples.size(); ++k) {
      const auto& sample = scan.samples[k];
      const auto& behind = expected.samples[k];
      if (sample.triangle >= ground) {
        ++on_bodies;
        // Nothing that stands still is nearer.
        ASSERT_FALSE(behind.range < sample.range) << "scan " << i << ", sample " << k;
        continue;
      }
      ASSERT_TRUE(sample.range == behind.range ||
                  (std::isnan(sample.range) && std::isnan(behind.range)));
      EXPECT_EQ(sample.triangle, behind.triangle);
    }
  }
  EXPECT_GT(on_bodies, 500u);
}
