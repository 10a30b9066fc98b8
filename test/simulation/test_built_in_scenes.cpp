// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace {
using pcl6d::builtInScene;
using pcl6d::SimulationOptions;
using pcl6d::SimulationScene;
using pcl6d::Simulator;
using pcl6d::Surface;

SimulationOptions
exactOptions(const SimulationScene& scene, int num_scans)
{
  SimulationOptions options;
  options.num_scans = num_scans;
  options.range.noise = 0;
  options.range.max_range = scene.max_range;
  return options;
}

std::map<std::string, int>
objectsByClass(const SimulationScene& scene)
{
  std::map<std::string, int> classes;
  for (const auto& object : scene.objects)
    ++classes[object.object_class];
  return classes;
}

// How often the way comes back to where the robot was at least 30 m of driving before.
int
revisits(const Simulator& simulator, double step)
{
  constexpr double kNear = 8; // [m] the width of a street
  const auto& poses = simulator.truth().poses;
  const auto skip = static_cast<std::size_t>(30 / step);
  int count = 0;
  bool was_known = false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    bool is_known = false;
    for (std::size_t k = 0; k + skip < i; ++k)
      is_known |= (poses[i].translation() - poses[k].translation()).norm() < kNear;
    count += is_known && !was_known;
    was_known = is_known;
  }
  return count;
}

class BuiltInScenes : public testing::TestWithParam<std::string> {
protected:
  const Surface&
  surfaceOf(std::uint32_t triangle) const
  {
    const pcl6d::TriangleScene& scene = simulator_.scene().scene();
    return scene.surfaces[scene.triangles[triangle].surface];
  }

  // When a sample of the i-th scan was measured [s].
  double
  timeOf(std::size_t i, std::size_t sample) const
  {
    const int per_line = simulator_.scanner().samplesPerLine();
    const int k = static_cast<int>(sample);
    return simulator_.truth().stamps[i] +
           simulator_.scanner().time(k / per_line, k % per_line);
  }

  const SimulationScene scene_ = builtInScene(GetParam());
  const Simulator simulator_{scene_, exactOptions(scene_, 6)};
};
} // namespace

TEST_P(BuiltInScenes, AreSeenFromTheFrontOnly)
{
  const pcl6d::MovingScene& scene = simulator_.scene();
  for (std::size_t i = 0; i < simulator_.size(); ++i) {
    const auto scan = simulator_.rangeScan(i);
    const auto cloud = simulator_.scan(i);
    const Eigen::Matrix3d R =
        (simulator_.sceneFromWorld() * simulator_.truth().poses[i]).linear();
    int behind = 0;
    int hits = 0;
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      if (!std::isfinite(cloud[k].x))
        continue;
      const Eigen::Vector3d ray = R * cloud[k].getVector3fMap().cast<double>();
      const std::uint32_t triangle = scan.samples[k].triangle;
      const Eigen::Vector3d normal = scene.poseOf(triangle, timeOf(i, k)).linear() *
                                     scene.scene().normal(triangle);
      behind += normal.dot(ray) > 1e-3 * ray.norm();
      ++hits;
    }
    EXPECT_EQ(behind, 0) << "scan " << i;
    EXPECT_GT(hits, 20000) << "scan " << i; // of 43 560 samples
  }
}

TEST_P(BuiltInScenes, KnowThePlaneOfEveryPoint)
{
  const auto planes = scenePlanes(scene_.geometry, simulator_.sceneFromWorld());
  for (const auto& plane : planes) {
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
    EXPECT_GE(plane.offset, 0);
    EXPECT_GE(plane.area, 0.1);
    ASSERT_GE(plane.hull.size(), 3u);
  }
  std::size_t on_planes = 0;
  for (std::size_t i = 0; i < simulator_.size(); ++i) {
    const auto scan = simulator_.rangeScan(i);
    const auto cloud = simulator_.scan(i);
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      if (!std::isfinite(cloud[k].x))
        continue;
      const Surface& surface = surfaceOf(scan.samples[k].triangle);
      if (surface.plane == 0)
        continue;
      ++on_planes;
      const auto& plane = planes.at(surface.plane - 1);
      const Eigen::Vector3d p =
          simulator_.truth().poses[i] * cloud[k].getVector3fMap().cast<double>();
      // Float at up to 60 m: half an ulp per coordinate is 2 um.
      ASSERT_NEAR(plane.normal.dot(p), plane.offset, 1e-5);
      EXPECT_EQ(plane.label, toString(surface.label));
    }
  }
  EXPECT_GT(on_planes, 1000u);
}

TEST_P(BuiltInScenes, KnowTheObjectOfEveryPoint)
{
  const auto objects = sceneObjects(scene_, simulator_.sceneFromWorld());
  for (std::size_t i = 0; i < simulator_.size(); ++i) {
    const auto scan = simulator_.rangeScan(i);
    const auto cloud = simulator_.scan(i);
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      if (!std::isfinite(cloud[k].x))
        continue;
      const auto triangle = scan.samples[k].triangle;
      const Surface& surface = surfaceOf(triangle);
      if (surface.object == 0)
        continue;
      const auto& object = objects.at(surface.object - 1);
      const Eigen::Isometry3d T_world_object =
          object.moves ? simulator_.sceneFromWorld().inverse() *
                             simulator_.scene().poseOf(triangle, timeOf(i, k))
                       : object.T_world_object;
      const Eigen::Vector3d p = T_world_object.inverse() * simulator_.truth().poses[i] *
                                cloud[k].getVector3fMap().cast<double>();
      ASSERT_LT(object.box.exteriorDistance(p), 1e-5) << object.object_class;
    }
  }
}

TEST_P(BuiltInScenes, AreTheSameForTheSameSeed)
{
  const SimulationScene again = builtInScene(GetParam());
  ASSERT_EQ(again.geometry.vertices.size(), scene_.geometry.vertices.size());
  for (std::size_t i = 0; i < again.geometry.vertices.size(); ++i)
    ASSERT_EQ(again.geometry.vertices[i], scene_.geometry.vertices[i]);
  ASSERT_EQ(again.waypoints.size(), scene_.waypoints.size());
  for (std::size_t i = 0; i < again.waypoints.size(); ++i)
    ASSERT_EQ(again.waypoints[i], scene_.waypoints[i]);
}

INSTANTIATE_TEST_SUITE_P(All,
                         BuiltInScenes,
                         testing::ValuesIn(pcl6d::builtInSceneNames()),
                         [](const auto& scene) { return scene.param; });

TEST(RoomsScene, IsAnotherFlatForAnotherSeedAndAlwaysFreeToDrive)
{
  std::set<std::size_t> sizes;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SimulationScene scene = builtInScene("rooms", seed);
    // Throws if the path leads through something.
    EXPECT_NO_THROW(Simulator(scene, exactOptions(scene, 80)));
    sizes.insert(scene.geometry.triangles.size());
    auto classes = objectsByClass(scene);
    EXPECT_GE(classes["chair"] + classes["table"] + classes["shelf"], 4);
  }
  EXPECT_GT(sizes.size(), 30u);
}

TEST(RoomsScene, HasEveryLabel)
{
  const SimulationScene scene = builtInScene("rooms");
  std::map<std::string, int> labels;
  for (const auto& plane : scenePlanes(scene.geometry))
    ++labels[plane.label];
  EXPECT_EQ(labels["floor"], 1);
  EXPECT_EQ(labels["ceiling"], 1);
  EXPECT_GE(labels["wall"], 20);
  EXPECT_GE(labels["door"], 12); // both sides of 6 doors at least
}

TEST(CampusScene, IsAWayOfAKilometreWithFiveLoops)
{
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SimulationScene scene = builtInScene("campus", seed);
    const Simulator simulator(scene, exactOptions(scene, scene.num_scans));
    EXPECT_GE(simulator.size(), 300u);
    const pcl6d::RobotPath path(scene.waypoints, {});
    EXPECT_NEAR(path.length(), 1000, 60);                               // [m]
    EXPECT_EQ(revisits(simulator, path.length() / scene.num_scans), 5); // E B F C H
    auto classes = objectsByClass(scene);
    EXPECT_GE(classes["tree"], 40);
    EXPECT_GE(classes["car"], 40);
    EXPECT_GE(classes["person"], 10);
    double low = 1e9;
    double high = -1e9;
    for (const auto& pose : simulator.truth().poses) {
      low = std::min(low, pose.translation().z());
      high = std::max(high, pose.translation().z());
    }
    EXPECT_GT(high - low, 2); // [m] of slopes
  }
}

TEST(MultilevelScene, LeadsUpARampAndDownStairs)
{
  const SimulationScene scene = builtInScene("multilevel");
  const Simulator simulator(scene, exactOptions(scene, 400));
  double high = 0;
  double steepest_up = 0;
  double steepest_down = 0;
  for (const auto& pose : simulator.truth().poses) {
    high = std::max(high, pose.translation().z());
    const Eigen::Matrix3d R = (simulator.sceneFromWorld() * pose).linear();
    steepest_up = std::max(steepest_up, R(2, 0));
    steepest_down = std::min(steepest_down, R(2, 0));
  }
  EXPECT_NEAR(high, 3.2, 0.05);
  EXPECT_NEAR(steepest_up, 0.158, 0.02); // 3.2 m over 20 m
  EXPECT_LT(steepest_down, -0.4);        // 3.2 m over 5.1 m, and from step to step
}

TEST(MineScene, IsRoughAndClimbs)
{
  const SimulationScene scene = builtInScene("mine");
  const SimulationScene other = builtInScene("mine", 2);
  EXPECT_NE(scene.geometry.vertices[100], other.geometry.vertices[100]);
  const Simulator simulator(scene, exactOptions(scene, 200));
  double low = 0;
  double high = 0;
  double steepest_aside = 0;
  for (const auto& pose : simulator.truth().poses) {
    low = std::min(low, pose.translation().z());
    high = std::max(high, pose.translation().z());
    const Eigen::Matrix3d R = (simulator.sceneFromWorld() * pose).linear();
    steepest_aside = std::max(steepest_aside, std::abs(R(2, 1)));
  }
  EXPECT_GT(high - low, 3); // [m]
  EXPECT_GT(steepest_aside, 0.02);
}
