// SPDX-License-Identifier: BSD-3-Clause
// The laws by which built-in scenes deceive: what looks the same, and what differs.
#include "exact_drive.h"

#include <pcl6d/common/random.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace {
using pcl6d::builtInScene;
using pcl6d::RangeScan;
using pcl6d::Ray;
using pcl6d::RayCaster;
using pcl6d::SimulationOptions;
using pcl6d::SimulationScene;
using pcl6d::Simulator;
using pcl6d::test::exactDrive;

constexpr double kSame = 1e-9; // [m] far above rounding, far below anything built

std::map<std::string, std::vector<Eigen::Isometry3d>>
posesByClass(const SimulationScene& scene)
{
  std::map<std::string, std::vector<Eigen::Isometry3d>> poses;
  for (const auto& object : scene.objects)
    poses[object.object_class].push_back(object.T_world_object);
  return poses;
}

// The share of samples that tell two scans apart.
double
shareOfDifferences(const RangeScan& a, const RangeScan& b)
{
  double count = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const double x = a.samples[i].range;
    const double y = b.samples[i].range;
    count += !(std::abs(x - y) < kSame || (std::isnan(x) && std::isnan(y)));
  }
  return count / static_cast<double>(a.samples.size());
}

Eigen::Vector3d
randomDirection(pcl6d::Random& random)
{
  Eigen::Vector3d direction;
  for (int axis = 0; axis < 3; ++axis)
    direction[axis] = random.normal();
  return direction.normalized();
}

// What a ray meets: the object (0: none) and where.
struct Sight {
  std::uint32_t object = 0;
  double range = 0;
  Eigen::Vector3d place;
};

Sight
look(const RayCaster& caster, const Ray& ray)
{
  const auto hit = caster.cast(ray);
  if (!hit)
    return {0, std::numeric_limits<double>::infinity(), ray.origin};
  const pcl6d::TriangleScene& scene = caster.scene();
  return {scene.surfaces[scene.triangles[hit->triangle].surface].object,
          hit->range,
          ray.origin + hit->range * ray.direction};
}

// Scans i and i + half of a drive around the car park.
double
differencesAfterHalfATurn(const SimulationScene& scene, int step, int& pairs)
{
  const Simulator simulator(scene, exactDrive(scene));
  const std::size_t half = simulator.size() / 2;
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear().diagonal() << -1, -1, 1;
  double most = 0;
  pairs = 0;
  for (std::size_t i = 0; i < half; i += static_cast<std::size_t>(step)) {
    const auto pose = [&](std::size_t k) {
      return simulator.sceneFromWorld() * simulator.truth().poses[k];
    };
    EXPECT_TRUE((turned * pose(i)).isApprox(pose(i + half), 1e-9));
    most = std::max(
        most,
        shareOfDifferences(simulator.rangeScan(i), simulator.rangeScan(i + half)));
    ++pairs;
  }
  return most;
}
} // namespace

TEST(ParkingScene, LooksTheSameAfterHalfATurnButForItsDetails)
{
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SimulationScene scene = builtInScene("parking", seed);
    ASSERT_EQ(scene.num_scans % 2, 0);
    int pairs = 0;
    const SimulationScene bare = withoutObjects(scene, {"van", "door", "pipe"});
    // Rays along an edge may fall to either side: none of 43 560 does.
    EXPECT_EQ(differencesAfterHalfATurn(bare, 4, pairs), 0);
    EXPECT_EQ(pairs, 7);
    const double with_details = differencesAfterHalfATurn(scene, 4, pairs);
    EXPECT_GT(with_details, 0);
    EXPECT_LT(with_details, 0.1);
  }
}

TEST(ParkingScene, HasThreeVansADoorAndAPipeOnceAndCarsInPairs)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto poses = posesByClass(builtInScene("parking", seed));
    EXPECT_EQ(poses["van"].size(), 3u);
    EXPECT_EQ(poses["door"].size(), 1u);
    EXPECT_EQ(poses["pipe"].size(), 1u);
    const auto& cars = poses["car"];
    ASSERT_EQ(cars.size() % 2, 0u);
    EXPECT_GE(cars.size(), 16u);
    for (std::size_t i = 0; i < cars.size(); i += 2) {
      EXPECT_EQ(cars[i].translation().head<2>(), -cars[i + 1].translation().head<2>());
      EXPECT_EQ(cars[i].linear().topLeftCorner(2, 2),
                -cars[i + 1].linear().topLeftCorner(2, 2));
    }
  }
}

TEST(TwinsScene, HasEqualRooms)
{
  constexpr double kPitch = 5; // [m]
  constexpr int kRooms = 4;
  const SimulationScene scene = builtInScene("twins");
  const RayCaster caster(scene.geometry);
  const auto isInside = [](const Eigen::Vector3d& p, double begin) {
    return p.y() > -kSame && p.x() > begin && p.x() < begin + kPitch;
  };
  pcl6d::Random random(1);
  int seen = 0;
  constexpr int kRays = 20000;
  for (int i = 0; i < kRays; ++i) {
    const Eigen::Vector3d direction = randomDirection(random);
    const Eigen::Vector3d place(random.uniform(1.2, 3), random.uniform(1.2, 2.6), 0.9);
    const Sight first = look(caster, {place, direction});
    if (!isInside(first.place, 0))
      continue; // through the door
    ++seen;
    for (int room = 1; room < kRooms; ++room) {
      const Eigen::Vector3d shift(room * kPitch, 0, 0);
      const Sight other = look(caster, {place + shift, direction});
      ASSERT_NEAR(other.range, first.range, kSame) << "room " << room << ", ray " << i;
    }
  }
  EXPECT_GT(seen, 0.9 * kRays);
  for (const auto& [name, poses] : posesByClass(scene)) {
    ASSERT_EQ(poses.size(), static_cast<std::size_t>(kRooms)) << name;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const Eigen::Isometry3d motion = poses[i] * poses[0].inverse();
      EXPECT_TRUE(motion.isApprox(Eigen::Isometry3d(Eigen::Translation3d(
                                      kPitch * static_cast<double>(i), 0, 0)),
                                  1e-12));
    }
  }
}

TEST(TunnelScene, LooksTheSameFromEverywhereAlongIt)
{
  const SimulationScene scene = builtInScene("tunnel");
  for (std::uint32_t i = 0; i < scene.geometry.triangles.size(); ++i)
    EXPECT_EQ(scene.geometry.normal(i).x(), 0) << "triangle " << i;
  double end = 0; // [m] along x
  for (const auto& vertex : scene.geometry.vertices)
    end = std::max(end, vertex.x());
  for (const auto& place : scene.waypoints)
    EXPECT_LT(std::abs(place.x()) + scene.max_range, end);
  const Simulator simulator(scene, exactDrive(scene));
  Eigen::Isometry3d pose = simulator.sceneFromWorld() * simulator.truth().poses[5];
  const auto scanAt = [&](double x) {
    pose.translation().x() = x;
    return castScan(
        simulator.caster(), simulator.scanner(), pose, exactDrive(scene).range);
  };
  const RangeScan first = scanAt(-25);
  for (const double x : {-13.7, 0.0, 8.1, 25.0})
    EXPECT_EQ(shareOfDifferences(first, scanAt(x)), 0) << "x = " << x;
}

TEST(ShelvesScene, RepeatsEveryMetre)
{
  constexpr std::uint32_t kBays = 16;
  const SimulationScene scene = builtInScene("shelves");
  const auto shelves = posesByClass(scene)["shelf"];
  ASSERT_EQ(shelves.size(), 4u * kBays);
  for (std::size_t i = 0; i < shelves.size(); ++i)
    if (i % kBays > 0) {
      EXPECT_EQ((shelves[i - 1].inverse() * shelves[i]).matrix(),
                Eigen::Isometry3d(Eigen::Translation3d(1, 0, 0)).matrix());
    }

  const RayCaster caster(scene.geometry);
  pcl6d::Random random(1);
  int seen = 0;
  constexpr int kRays = 20000;
  for (int i = 0; i < kRays; ++i) {
    const Ray ray = {{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 1.2},
                     randomDirection(random)};
    const Sight first = look(caster, ray);
    if (std::abs(first.place.x()) > 6 || first.object == 0)
      continue; // beyond the heads of the rows, or no shelf
    ++seen;
    const Sight next =
        look(caster, {ray.origin + Eigen::Vector3d::UnitX(), ray.direction});
    ASSERT_NEAR(next.range, first.range, kSame) << "ray " << i;
    // Uprights stand where two bays meet.
    EXPECT_EQ(next.object, first.object + 1) << "ray " << i;
  }
  EXPECT_GT(seen, kRays / 4);
}

TEST(GlassScene, SendsBackOneRayInFiveFromItsPanes)
{
  const SimulationScene scene = builtInScene("glass");
  const Simulator simulator(scene, exactDrive(scene));
  const auto& geometry = scene.geometry;
  const auto surfaceOf = [&](std::uint32_t triangle) {
    return geometry.surfaces[geometry.triangles[triangle].surface];
  };
  double onto = 0;
  double back = 0;
  for (std::size_t i = 0; i < simulator.size(); i += 5) {
    const RangeScan scan = simulator.rangeScan(i);
    const Eigen::Isometry3d pose =
        simulator.sceneFromWorld() * simulator.truth().poses[i];
    for (std::size_t k = 0; k < scan.samples.size(); ++k) {
      const int per_line = scan.samples_per_line;
      const Ray ray = simulator.scanner().ray(static_cast<int>(k) / per_line,
                                              static_cast<int>(k) % per_line);
      const auto first =
          simulator.caster().cast({pose * ray.origin, pose.linear() * ray.direction});
      if (surfaceOf(first->triangle).name != "glass")
        continue;
      ++onto;
      back += scan.samples[k].triangle == first->triangle;
    }
  }
  EXPECT_GT(onto, 50000);
  EXPECT_NEAR(back / onto, 0.2, 5 * std::sqrt(0.2 * 0.8 / onto));
}
