// SPDX-License-Identifier: BSD-3-Clause
#include "body_checks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/simulation/intruders.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace {
using pcl6d::BadArgument;
using pcl6d::ComputeFailed;
using pcl6d::IntrudedPoints;
using pcl6d::IntruderOptions;
using pcl6d::Intruders;
using pcl6d::Points;
using pcl6d::Trajectory;

constexpr double kNoise = 0.01; // [m]

// "Recorded" scans of the crowd's square without its crowd, in a world that is tilted.
struct Recording {
  Trajectory scans;
  std::vector<Points> points;
  Eigen::Isometry3d T_world_scene;
  Eigen::Vector3d up;

  Recording()
  {
    auto scene = pcl6d::builtInScene("crowd");
    scene.moving.clear();
    pcl6d::SimulationOptions options;
    options.num_scans = 8;
    options.range.noise = kNoise;
    const pcl6d::Simulator simulator(scene, options);
    T_world_scene = pcl6d::poseFromEuler({3, -2, 5}, {0.3, -0.2, 1});
    up = T_world_scene.linear().col(2);
    for (std::size_t i = 0; i < simulator.size(); ++i) {
      scans.poses.push_back(T_world_scene * simulator.sceneFromWorld() *
                            simulator.truth().poses[i]);
      scans.stamps.push_back(2.5 * static_cast<double>(i));
      points.push_back(pcl6d::toPoints(simulator.scan(i))); // with NaN
    }
  }
};

const Recording&
recording()
{
  static const Recording it;
  return it;
}

IntruderOptions
somePeople()
{
  IntruderOptions options;
  options.people = 4;
  options.cars = 1;
  options.up = 3 * recording().up;
  return options;
}

Intruders
intruders(const IntruderOptions& options)
{
  return Intruders(
      recording().scans, [](std::size_t i) { return recording().points[i]; }, options);
}

bool
areSame(const IntrudedPoints& a, const IntrudedPoints& b)
{
  return a.indices == b.indices && a.bodies == b.bodies &&
         a.points.size() == b.points.size() &&
         std::memcmp(a.points.data(),
                     b.points.data(),
                     a.points.size() * sizeof(Eigen::Vector3f)) == 0;
}

// The pose of a body in the world at a scan.
Eigen::Isometry3d
poseIn(const Intruders& some, std::size_t body, std::size_t scan)
{
  return some.worldFromLevel() * some.body(body).poseAt(recording().scans.stamps[scan]);
}
} // namespace

TEST(Intruders, EachMovedPointIsOnItsBodyAndOnItsOldRay)
{
  const Intruders some = intruders(somePeople());
  ASSERT_EQ(some.size(), 5u);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < recording().points.size(); ++i) {
    const Points& measured = recording().points[i];
    const IntrudedPoints now = some.enter(i, measured);
    moved += now.indices.size();
    for (std::size_t k = 0; k < now.indices.size(); ++k) {
      const Eigen::Vector3d old = measured[now.indices[k]].cast<double>();
      const Eigen::Vector3d p = now.points[k].cast<double>();
      ASSERT_LT(p.norm(), old.norm());
      ASSERT_LT(p.cross(old).norm() / old.norm(), 1e-5) << "off its ray, in float";
      if (k % 20 > 0)
        continue;
      const Eigen::Isometry3d T_world_body = poseIn(some, now.bodies[k], i);
      const double off = pcl6d::test::distanceTo(some.body(now.bodies[k]).shape,
                                                 T_world_body.inverse() *
                                                     recording().scans.poses[i] * p);
      EXPECT_LT(off, 6 * kNoise * 1.25) << "rangeNoise() is good within 25 %";
    }
  }
  EXPECT_GT(moved, 1000u);
}

TEST(Intruders, NoPointIsLeftBehindABody)
{
  const Intruders some = intruders(somePeople());
  for (const std::size_t i : {0, 3, 7}) {
    const Points& measured = recording().points[i];
    const IntrudedPoints now = some.enter(i, measured);
    std::vector<char> has_moved(measured.size(), 0);
    for (const auto index : now.indices)
      has_moved[index] = 1;
    for (std::size_t body = 0; body < some.size(); ++body) {
      const pcl6d::RayCaster caster(some.body(body).shape);
      const Eigen::Isometry3d T_body_scan =
          poseIn(some, body, i).inverse() * recording().scans.poses[i];
      for (std::size_t k = 0; k < measured.size(); k += 7) {
        if (!measured[k].allFinite() || has_moved[k] != 0)
          continue;
        const Eigen::Vector3d p = measured[k].cast<double>();
        const auto hit = caster.cast(
            {T_body_scan.translation(), T_body_scan.linear() * p.normalized()});
        EXPECT_FALSE(hit && hit->range < p.norm() - 3 * 1.25 * kNoise - 1e-6)
            << "scan " << i << ", point " << k << ", body " << body;
      }
    }
  }
}

TEST(Intruders, WalkUprightOnTheGround)
{
  const Intruders some = intruders(somePeople());
  for (std::size_t body = 0; body < some.size(); ++body)
    for (std::size_t i = 0; i < recording().scans.poses.size(); ++i) {
      const Eigen::Isometry3d T_scene_body =
          recording().T_world_scene.inverse() * poseIn(some, body, i);
      EXPECT_NEAR(T_scene_body.translation().z(), 0, 0.04);
      EXPECT_GT(T_scene_body.linear()(2, 2),
                some.body(body).name == "car" ? 0.99 : 1 - 1e-9);
      EXPECT_GT((T_scene_body.inverse() * recording().T_world_scene.inverse() *
                 recording().scans.poses[i].translation())
                    .head<2>()
                    .norm(),
                1.1);
    }
}

TEST(Intruders, HaveTheSameBytesForEveryThreadCountAndOtherWaysForAnotherSeed)
{
  IntruderOptions options = somePeople();
  options.num_threads = 1;
  const IntrudedPoints expected = intruders(options).enter(2, recording().points[2]);
  ASSERT_FALSE(expected.indices.empty());
  for (const unsigned threads : {2u, 8u}) {
    options.num_threads = threads;
    EXPECT_TRUE(areSame(intruders(options).enter(2, recording().points[2]), expected));
  }
  options.seed = 2;
  EXPECT_FALSE(areSame(intruders(options).enter(2, recording().points[2]), expected));
}

TEST(Intruders, LeavePointsWithoutRangeAlone)
{
  const Intruders some = intruders(somePeople());
  const Points nothing = {{NAN, 0, 0}, {0, 0, 0}, {INFINITY, 1, 1}};
  EXPECT_TRUE(some.enter(0, nothing).indices.empty());
  EXPECT_TRUE(some.enter(0, {}).indices.empty());
}

TEST(Intruders, RefuseWhatCannotBe)
{
  const auto refused = [](const auto& spoil) {
    IntruderOptions options = somePeople();
    spoil(options);
    EXPECT_THROW(intruders(options), BadArgument);
  };
  refused([](auto& o) { o.people = o.cars = 0; });
  refused([](auto& o) { o.people = -1; });
  refused([](auto& o) { o.cars = 201; });
  refused([](auto& o) { o.up.setZero(); });
  refused([](auto& o) { o.up.x() = std::nan(""); });
  const auto points = [](std::size_t i) { return recording().points[i]; };
  EXPECT_THROW(Intruders({}, points, somePeople()), BadArgument);
  Trajectory untimed = recording().scans;
  untimed.stamps.clear();
  EXPECT_THROW(Intruders(untimed, points, somePeople()), BadArgument);
  Trajectory back = recording().scans;
  back.stamps[3] = back.stamps[2];
  EXPECT_THROW(Intruders(back, points, somePeople()), BadArgument);
  EXPECT_THROW(
      Intruders(
          recording().scans, [](std::size_t) { return Points{}; }, somePeople()),
      ComputeFailed)
      << "no ground";
  const Intruders some = intruders(somePeople());
  EXPECT_THROW(some.enter(8, {}), BadArgument);
  EXPECT_THROW(some.body(5), BadArgument);
}
