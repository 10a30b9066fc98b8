// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/robot_path.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>

namespace {
constexpr double kClearance = 0.25; // [m] half the width of a slim robot

// Distance from a point to a triangle: to its inside if the foot lies there, else to
// the nearest edge.
double
distanceTo(const Eigen::Vector3d& p,
           const Eigen::Vector3d& a,
           const Eigen::Vector3d& b,
           const Eigen::Vector3d& c)
{
  const auto to_edge = [&p](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d edge = to - from;
    const double t = std::clamp((p - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    return (from + t * edge - p).norm();
  };
  const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
  const auto inside = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return n.dot((to - from).cross(p - from)) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a))
    return std::abs(n.dot(p - a));
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

double
distanceToScene(const pcl6d::TriangleScene& scene, const Eigen::Vector3d& p)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
    nearest = std::min(
        nearest,
        distanceTo(p, scene.corner(i, 0), scene.corner(i, 1), scene.corner(i, 2)));
  return nearest;
}

class CorridorScene : public testing::Test {
protected:
  const pcl6d::SimulationScene scene_ = pcl6d::builtInScene("corridor");
  const pcl6d::RayCaster caster_{scene_.geometry};
  const pcl6d::RobotOptions robot_;
  const pcl6d::RobotPath path_{scene_.waypoints, robot_};
};
} // namespace

TEST_F(CorridorScene, IsALoopOf50To70Metres)
{
  EXPECT_GE(path_.length(), 50);
  EXPECT_LE(path_.length(), 70);
}

TEST_F(CorridorScene, KeepsTheRobotClearOfAllSurfaces)
{
  const double foot = -robot_.sensor_height;
  for (double s = 0; s < path_.length(); s += 0.1) {
    const Eigen::Isometry3d pose = path_.sensorPose(caster_, s);
    for (const double height : {foot + 0.3, foot + 0.6, 0.0})
      EXPECT_GE(distanceToScene(scene_.geometry, pose * Eigen::Vector3d(0, 0, height)),
                kClearance)
          << "s = " << s << " m, " << height << " m from the sensor";
  }
}

TEST_F(CorridorScene, IsClosedOnAllSides)
{
  pcl6d::DrivenScannerOptions sphere = pcl6d::rotatingScanner();
  sphere.beam = {-M_PI / 2, M_PI / 2, 181};
  const pcl6d::DrivenScanner scanner(sphere);
  pcl6d::RangeOptions range;
  range.noise = 0;
  range.min_range = 0;
  for (double s = 0; s < path_.length(); s += 2) {
    const auto scan = castScan(caster_, scanner, path_.sensorPose(caster_, s), range);
    const auto misses =
        std::count_if(scan.samples.begin(), scan.samples.end(), [](const auto& sample) {
          return std::isnan(sample.range);
        });
    EXPECT_EQ(misses, 0) << "s = " << s << " m";
  }
}

TEST_F(CorridorScene, ChangesHeightAndSlope)
{
  double low = 1e9;
  double high = -1e9;
  double steepest = 0;
  double most_sideways = 0;
  for (double s = 0; s < path_.length(); s += 0.2) {
    const Eigen::Isometry3d pose = path_.sensorPose(caster_, s);
    low = std::min(low, pose.translation().z());
    high = std::max(high, pose.translation().z());
    steepest = std::max(steepest, std::abs(pose.linear()(2, 0)));
    most_sideways = std::max(most_sideways, std::abs(pose.linear()(2, 1)));
  }
  EXPECT_GT(high - low, 0.5);                           // [m]
  EXPECT_GT(steepest, std::sin(5 * M_PI / 180));        // pitch
  EXPECT_GT(most_sideways, std::sin(0.3 * M_PI / 180)); // roll: the way weaves
}

TEST_F(CorridorScene, HasSurfacesAcrossTheWayEverywhere)
{
  // Whoever slides along the way must see it: of the points of a scan within 5 m, a
  // good share lie on surfaces that face along the way.
  const pcl6d::DrivenScanner scanner;
  for (double s = 0; s < path_.length(); s += 1) {
    const Eigen::Isometry3d pose = path_.sensorPose(caster_, s);
    const auto scan = castScan(caster_, scanner, pose);
    int near = 0;
    int across = 0;
    for (const auto& sample : scan.samples) {
      if (!(sample.range < 5))
        continue;
      ++near;
      const Eigen::Vector3d n = scene_.geometry.normal(sample.triangle);
      across += std::abs(n.dot(pose.linear().col(0))) > 0.7;
    }
    EXPECT_GT(across, 0.02 * near) << "s = " << s << " m";
  }
}

TEST(BuiltInScene, UnknownNameListsTheKnownOnes)
{
  try {
    pcl6d::builtInScene("cathedral");
    FAIL() << "nothing thrown";
  } catch (const pcl6d::BadArgument& e) {
    EXPECT_STREQ(e.what(),
                 "no scene 'cathedral'; known: corridor, campus, crowd, glass, mine, "
                 "multilevel, "
                 "parking, rooms, shelves, tunnel, twins");
  }
  for (const auto& name : pcl6d::builtInSceneNames())
    EXPECT_EQ(pcl6d::builtInScene(name).name, name);
}
