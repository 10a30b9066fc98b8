// SPDX-License-Identifier: BSD-3-Clause
// The simulator on the move, and motion correction of what it scans.
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/deskew/motion_correction.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/simulator.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace {
using pcl6d::MotionCorrection;
using pcl6d::OdometryKind;
using pcl6d::Points;
using pcl6d::ScanMotion;
using pcl6d::SimulationOptions;
using pcl6d::SimulationScene;
using pcl6d::Simulator;

SimulationOptions
onTheMove()
{
  SimulationOptions options;
  options.motion = ScanMotion::kContinuous;
  options.range.noise = 0;
  return options;
}

// A box of 40 m x 26 m x 5 m seen from inside, and a way that starts with 8 m straight
// along x.
SimulationScene
closedHall()
{
  SimulationScene scene;
  pcl6d::TriangleScene& walls = scene.geometry;
  pcl6d::addBox(walls, {-20, -20, -1}, {20, 20, 0}, {"floor", 0.5});
  pcl6d::addBox(walls, {-20, -20, 5}, {20, 20, 6}, {"ceiling", 0.5});
  pcl6d::addBox(walls, {20, -20, 0}, {21, 20, 5}, {"east", 0.5});
  pcl6d::addBox(walls, {-21, -20, 0}, {-20, 20, 5}, {"west", 0.5});
  pcl6d::addBox(walls, {-20, 6, 0}, {20, 7, 5}, {"north", 0.5});
  pcl6d::addBox(walls, {-20, -20, 0}, {20, -19, 5}, {"south", 0.5});
  scene.waypoints = {
      {-2, 0, 0}, {2, 0, 0}, {6, 0, 0}, {9, -6, 0}, {-9, -6, 0}, {-6, 0, 0}};
  return scene;
}

pcl6d::MovingBody
passerBy()
{
  pcl6d::MovingBody body;
  body.name = "person";
  pcl6d::addBox(body.shape, {-0.2, -0.3, 0}, {0.2, 0.3, 1.8}, {"person", 0.5});
  body.way = {{-5, 3, 0}, {5, 3, 0}};
  body.speed = 1.4;
  return body;
}

double
timeOf(const pcl6d::ScannerModel& scanner, std::size_t k)
{
  const auto per_line = static_cast<std::size_t>(scanner.samplesPerLine());
  return scanner.time(static_cast<int>(k / per_line), static_cast<int>(k % per_line));
}

// The largest distance [m] of the points of a scan from the triangles that they hit, each
// moved by the pose at its own time.
double
farthestFromSurface(const Simulator& simulator, std::size_t i)
{
  const auto samples = simulator.rangeScan(i).samples;
  const auto cloud = simulator.scan(i);
  const auto& scene = simulator.scene().scene();
  double farthest = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!std::isfinite(samples[k].range))
      continue;
    const double time = timeOf(simulator.scanner(), k);
    const auto triangle = samples[k].triangle;
    const Eigen::Isometry3d T_scene_body =
        simulator.scene().poseOf(triangle, simulator.truth().stamps[i] + time);
    const Eigen::Vector3d p = T_scene_body.inverse() * simulator.sceneFromWorld() *
                              simulator.scanPose(i, time) *
                              cloud[k].getVector3fMap().cast<double>();
    farthest = std::max(
        farthest, std::abs(scene.normal(triangle).dot(p - scene.corner(triangle, 0))));
  }
  return farthest;
}

constexpr double kFloat = 5e-6; // [m] three coordinates below 32 m in float, with spare

struct WallPoints {
  Points points;
  std::vector<double> times; // [s] since the stamp
};

// What the i-th scan has of a surface, as a cloud says it: time in float.
WallPoints
pointsOn(const std::string& surface, const Simulator& simulator, std::size_t i)
{
  const auto samples = simulator.rangeScan(i).samples;
  const auto cloud = simulator.scan(i);
  const auto& scene = simulator.scene().scene();
  WallPoints wall;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (std::isfinite(samples[k].range) &&
        scene.surfaces[scene.triangles[samples[k].triangle].surface].name == surface) {
      wall.points.push_back(cloud[k].getVector3fMap());
      wall.times.push_back(static_cast<float>(timeOf(simulator.scanner(), k)));
    }
  return wall;
}

// The distances [m] of points from their best plane.
struct Flatness {
  double rms = 0;
  double largest = 0;
};

Flatness
flatness(const Points& points)
{
  const auto count = static_cast<double>(points.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    mean += p.cast<double>() / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points)
    scatter += (p.cast<double>() - mean) * (p.cast<double>() - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Flatness result;
  for (const auto& p : points) {
    const double off = solver.eigenvectors().col(0).dot(p.cast<double>() - mean);
    result.rms += off * off / count;
    result.largest = std::max(result.largest, std::abs(off));
  }
  result.rms = std::sqrt(result.rms);
  return result;
}
} // namespace

TEST(SimulatorOnTheMove, EachPointLiesOnItsSurfaceAtItsOwnTime)
{
  SimulationScene scene = pcl6d::builtInScene("corridor");
  scene.moving = {passerBy()};
  scene.moving[0].way = {{3.5, 0.4, 0}, {14, 0.4, 0}};
  auto options = onTheMove();
  options.num_scans = 16;
  const Simulator simulator(scene, options);
  std::size_t on_body = 0;
  for (const std::size_t i : {0, 1, 2, 5, 15}) {
    EXPECT_LT(farthestFromSurface(simulator, i), kFloat) << "scan " << i;
    on_body += pointsOn("person", simulator, i).points.size();
  }
  EXPECT_GT(on_body, 100u); // the test did see it
}

TEST(SimulatorOnTheMove, TheSameOfARoughDrive)
{
  auto options = onTheMove();
  options.scanner = pcl6d::scannerByName("ouster", 3 * M_PI / 180).scanner;
  options.num_scans = 30;
  options.period = options.scanner->duration();
  options.turns_in_place = true;
  options.vibration = 0.002;
  const Simulator simulator(pcl6d::builtInScene("corridor"), options);
  for (const std::size_t i : {0, 17})
    EXPECT_LT(farthestFromSurface(simulator, i), kFloat);
}

TEST(SimulatorOnTheMove, BodiesMoveWhileItStandsToo)
{
  SimulationScene scene = closedHall();
  scene.moving = {passerBy()};
  SimulationOptions options;
  options.range.noise = 0;
  options.num_scans = 10;
  const Simulator simulator(scene, options);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(farthestFromSurface(simulator, i), kFloat);
    EXPECT_EQ(simulator.scanPose(i, 3).matrix(), simulator.truth().poses[i].matrix());
  }
  EXPECT_GT(pointsOn("person", simulator, 0).points.size(), 40u);
}

TEST(SimulatorOnTheMove, ThePoseIsThatAtTheStamp)
{
  const Simulator simulator(pcl6d::builtInScene("corridor"), onTheMove());
  EXPECT_EQ(simulator.truth().poses[0].matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(simulator.truth().stamps[0], 0);
  ASSERT_EQ(simulator.truth().stamps.size(), 40u);
  EXPECT_EQ(simulator.odometry().stamps, simulator.truth().stamps);
  const double duration = simulator.scanner().duration();
  for (std::size_t i = 0; i < 40; ++i) {
    const auto& truth = simulator.truth();
    const auto error = pcl6d::distanceBetween(truth.poses[i], simulator.scanPose(i, 0));
    EXPECT_LT(error.translation, 1e-12);
    const auto moved = pcl6d::distanceBetween(simulator.scanPose(i, 0),
                                              simulator.scanPose(i, duration));
    EXPECT_NEAR(moved.translation, simulator.speed() * duration, 0.15);
    if (i > 0) {
      EXPECT_GE(truth.stamps[i] - truth.stamps[i - 1], duration);
    }
  }
}

// The wall behind is seen at the start and at the end of the scan, 1.2 m farther on.
TEST(SimulatorOnTheMove, AWallIsFlatAgainAfterMotionCorrection)
{
  auto options = onTheMove();
  options.num_scans = 26;
  options.odometry_kind = OdometryKind::kExact;
  options.speed = 0.25; // [m/s]
  const Simulator simulator(closedHall(), options);
  const MotionCorrection correction(simulator.odometry());
  for (const std::size_t i : {1, 2, 3}) { // on the straight leg
    WallPoints wall = pointsOn("west", simulator, i);
    ASSERT_GT(wall.points.size(), 300u);
    const Flatness raw = flatness(wall.points);
    correction.correct(wall.points, wall.times, simulator.truth().stamps[i]);
    const Flatness corrected = flatness(wall.points);
    EXPECT_GT(raw.rms, 0.1);
    EXPECT_LT(corrected.largest, kFloat);
    RecordProperty("scan " + std::to_string(i),
                   std::to_string(1e3 * raw.rms) + " mm rms before, " +
                       std::to_string(1e3 * corrected.rms) + " mm after");
  }
}

TEST(SimulatorOnTheMove, HasTheSameBytesForEveryThreadCount)
{
  SimulationScene scene = pcl6d::builtInScene("corridor");
  scene.moving = {passerBy()};
  auto options = onTheMove();
  options.range.noise = 0.01;
  options.num_scans = 16;
  options.range.num_threads = 1;
  const auto expected = Simulator(scene, options).rangeScan(1).samples;
  for (const unsigned threads : {2u, 8u}) {
    options.range.num_threads = threads;
    const auto samples = Simulator(scene, options).rangeScan(1).samples;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      ASSERT_EQ(std::memcmp(&samples[k].range, &expected[k].range, sizeof(double)), 0);
      ASSERT_EQ(samples[k].triangle, expected[k].triangle);
    }
  }
}

TEST(SimulatorOnTheMove, HasTheOdometryThatIsAskedFor)
{
  auto options = onTheMove();
  const auto offBy = [&](OdometryKind kind) {
    options.odometry_kind = kind;
    const Simulator simulator(pcl6d::builtInScene("corridor"), options);
    double largest = 0;
    for (std::size_t i = 0; i < simulator.size(); ++i)
      largest = std::max(largest,
                         pcl6d::distanceBetween(simulator.truth().poses[i],
                                                simulator.odometry().poses[i])
                             .translation);
    return largest;
  };
  EXPECT_EQ(offBy(OdometryKind::kExact), 0);
  EXPECT_GT(offBy(OdometryKind::kVisualInertial), 0.05);
  EXPECT_LT(offBy(OdometryKind::kVisualInertial), 0.5);
  EXPECT_GT(offBy(OdometryKind::kWheel), 1);
}

TEST(SimulatorOnTheMove, DerivesASpeedThatLeavesTimeForEachScan)
{
  auto options = onTheMove();
  const Simulator slow(pcl6d::builtInScene("corridor"), options);
  EXPECT_LT(slow.speed(), 1);
  options.num_scans = 4;
  EXPECT_EQ(Simulator(pcl6d::builtInScene("corridor"), options).speed(), 1);
}

TEST(SimulatorOnTheMove, RefusesSpeedsThatCannotBe)
{
  auto options = onTheMove();
  for (const double speed : {0.0, -1.0, 1000.0, std::nan(""), 3.0}) {
    options.speed = speed;
    EXPECT_THROW(Simulator(pcl6d::builtInScene("corridor"), options),
                 pcl6d::BadArgument)
        << speed;
  }
  try {
    options.speed = 3;
    Simulator(pcl6d::builtInScene("corridor"), options);
  } catch (const pcl6d::BadArgument& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("speed = 3, but must be at most 0.28"), std::string::npos)
        << message;
    EXPECT_NE(message.find("a scan takes 4.8"), std::string::npos) << message;
  }
  EXPECT_EQ(pcl6d::scanMotionFromName("stop"), ScanMotion::kStop);
  EXPECT_EQ(pcl6d::scanMotionFromName("continuous"), ScanMotion::kContinuous);
  EXPECT_THROW(pcl6d::scanMotionFromName("jump"), pcl6d::BadArgument);
  EXPECT_EQ(pcl6d::odometryKindFromName("wheel"), OdometryKind::kWheel);
  EXPECT_EQ(pcl6d::odometryKindFromName("visual-inertial"),
            OdometryKind::kVisualInertial);
  EXPECT_EQ(pcl6d::odometryKindFromName("exact"), OdometryKind::kExact);
  EXPECT_THROW(pcl6d::odometryKindFromName("gps"), pcl6d::BadArgument);
}
