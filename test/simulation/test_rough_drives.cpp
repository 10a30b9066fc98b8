// SPDX-License-Identifier: BSD-3-Clause
// Drives that slow down, turn in place, shake, and scan without a pause.
#include "ride.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/robot_motion.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::RayCaster;
using pcl6d::RobotMotion;
using pcl6d::RobotPath;
using pcl6d::ScanMotion;
using pcl6d::SimulationOptions;
using pcl6d::Simulator;
using pcl6d::test::kSpeed;
using pcl6d::test::ride;

SimulationOptions
sweeping()
{
  SimulationOptions options;
  options.motion = ScanMotion::kContinuous;
  options.range.noise = 0;
  return options;
}

constexpr double kTurnRate = 30 * M_PI / 180; // [rad/s]

// A square of 8 m on a flat floor.
const std::vector<Eigen::Vector3d> kSquare = {{-4, -4, 0},
                                              {4, -4, 0},
                                              {4, 4, 0},
                                              {-4, 4, 0}};

RayCaster
floorOnly()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-10, -10, -1}, {10, 10, 0}, {"floor", 0.5});
  return RayCaster(scene);
}

RobotMotion
onTheSquare(pcl6d::PathCorners corners, const pcl6d::RobotMotionOptions& options)
{
  return RobotMotion(RobotPath(kSquare, {}, corners), floorOnly(), options);
}

// How fast it drives [m/s] and turns [rad/s], between times 1 ms apart.
pcl6d::MotionSize
ratesAt(const RobotMotion& motion, double time)
{
  constexpr double h = 1e-3; // [s]
  const auto step =
      pcl6d::distanceBetween(motion.poseAt(time), motion.poseAt(time + h));
  return {step.translation / h, step.rotation / h};
}
} // namespace

TEST(RobotMotion, TurnsInPlaceAtSharpCorners)
{
  pcl6d::RobotMotionOptions options = ride();
  options.turn_rate = kTurnRate;
  const RobotMotion motion = onTheSquare(pcl6d::PathCorners::kSharp, options);
  const double leg = 8 / kSpeed, turn = M_PI / 2 / kTurnRate; // [s]
  EXPECT_NEAR(motion.duration(), 4 * (leg + turn), 1e-9);
  for (double time = 0; time < motion.duration(); time += 0.05) {
    const double in_round = std::fmod(time, leg + turn);
    const auto rates = ratesAt(motion, time);
    EXPECT_LT(rates.translation, kSpeed * (1 + 1e-3)) << time;
    EXPECT_LT(rates.rotation, kTurnRate * (1 + 1e-3)) << time;
    // Two knots of 0.1 s, and 1 ms, on either side of a stop are neither.
    if (in_round > 0.21 && in_round < leg - 0.21) {
      EXPECT_NEAR(rates.translation, kSpeed, 1e-3) << time;
      EXPECT_NEAR(rates.rotation, 0, 1e-3) << time;
    }
    else if (in_round > leg + 0.21 && in_round < leg + turn - 0.21) {
      EXPECT_NEAR(rates.translation, 0, 1e-3) << time;
      EXPECT_NEAR(rates.rotation, kTurnRate, 0.01 * kTurnRate) << time;
    }
  }
  const Eigen::Isometry3d turned = motion.poseAt(leg + turn / 2);
  EXPECT_LT((turned.translation() - Eigen::Vector3d(4, -4, 0.9)).norm(), 1e-6);
  EXPECT_NEAR(pcl6d::eulerFromRotation(turned.linear()).yaw, M_PI / 4, 1e-3);
}

TEST(RobotMotion, SlowsDownInBendsToItsTurnRate)
{
  pcl6d::RobotMotionOptions options = ride();
  options.speed = 3; // the bends have radii from 2 m on: it would turn at 1.5 rad/s
  const RobotMotion fast = onTheSquare(pcl6d::PathCorners::kRounded, options);
  options.turn_rate = kTurnRate;
  const RobotMotion slow = onTheSquare(pcl6d::PathCorners::kRounded, options);
  double fastest_turn = 0;
  double top_speed = 0;
  for (double time = 0; time < slow.duration(); time += 0.02) {
    const auto rates = ratesAt(slow, time);
    EXPECT_LT(rates.rotation, kTurnRate * 1.01) << time;
    EXPECT_LT(rates.translation, 3 * 1.01) << time; // the way is measured along chords
    top_speed = std::max(top_speed, rates.translation);
    fastest_turn = std::max(fastest_turn, ratesAt(fast, time).rotation);
  }
  EXPECT_GT(fastest_turn, 1);
  EXPECT_GT(slow.duration(), fast.duration() * 1.2);
  EXPECT_GT(top_speed, 1);
}

TEST(RobotMotion, ShakesAsMuchAsItIsToldAndNoFasterThanTenHertz)
{
  pcl6d::RobotMotionOptions options = ride();
  options.turn_rate = kTurnRate;
  const RobotMotion smooth = onTheSquare(pcl6d::PathCorners::kSharp, options);
  options.vibration = 0.004;
  const RobotMotion shaken = onTheSquare(pcl6d::PathCorners::kSharp, options);
  EXPECT_EQ(shaken.duration(), smooth.duration());
  constexpr double h = 1e-3; // [s]
  double moved = 0, turned = 0, faster = 0;
  int count = 0;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (double time = 0; time < shaken.duration(); time += h, ++count) {
    const Eigen::Isometry3d shake = smooth.poseAt(time).inverse() * shaken.poseAt(time);
    moved += shake.translation().squaredNorm();
    turned += std::pow(
        pcl6d::distanceBetween(Eigen::Isometry3d::Identity(), shake).rotation, 2);
    if (count > 0)
      faster += (shake.translation() - before).squaredNorm() / (h * h);
    before = shake.translation();
  }
  // Sines of a whole round are orthogonal but where two have one frequency.
  EXPECT_NEAR(std::sqrt(moved / count), 0.004, 0.05 * 0.004);
  const double lever = pcl6d::RobotOptions().wheel_base;
  EXPECT_NEAR(
      std::sqrt(turned / count), 0.004 * std::sqrt(2) / lever, 0.1 * 0.004 / lever);
  // The rms of speed over that of distance is the rms of 2 pi f.
  const double frequency = std::sqrt(faster / moved) / (2 * M_PI);
  EXPECT_GT(frequency, 2);
  EXPECT_LT(frequency, 10);
  options.seed = 2;
  const RobotMotion other = onTheSquare(pcl6d::PathCorners::kSharp, options);
  EXPECT_GT(pcl6d::distanceBetween(other.poseAt(3), shaken.poseAt(3)).translation,
            1e-6);
}

TEST(RobotMotion, RefusesWhatNoRobotDoes)
{
  const auto refused = [](const auto& spoil) {
    pcl6d::RobotMotionOptions options = ride();
    spoil(options);
    EXPECT_THROW(onTheSquare(pcl6d::PathCorners::kRounded, options),
                 pcl6d::BadArgument);
  };
  for (const double speed : {0.0, -1.0, 50.1, std::nan("")})
    refused([&](auto& options) { options.speed = speed; });
  for (const double rate : {0.0, -1.0, 10.1, std::nan("")})
    refused([&](auto& options) { options.turn_rate = rate; });
  for (const double vibration : {-0.001, 0.11, std::nan("")})
    refused([&](auto& options) { options.vibration = vibration; });
  refused([](auto& options) { // 32 m in 37 days
    options.speed = 1e-5;
    options.turn_rate = 1;
  });
  refused([](auto& options) { // in 9 hours
    options.speed = 1e-3;
    options.vibration = 0.001;
  });
  EXPECT_THROW(onTheSquare(pcl6d::PathCorners::kSharp, ride()), pcl6d::BadArgument)
      << "no turn rate for the corners";
  EXPECT_THROW(pcl6d::PoseSpline({}, 1), pcl6d::BadArgument);
}

TEST(SimulatorOnTheMove, SweepsFollowEachOtherWithoutAPause)
{
  auto options = sweeping();
  const auto preset = pcl6d::scannerByName("ouster", 3 * M_PI / 180);
  options.scanner = preset.scanner;
  options.num_scans = 30;
  options.period = preset.scanner->duration();
  options.turns_in_place = true;
  options.vibration = 0.002;
  const Simulator simulator(pcl6d::builtInScene("corridor"), options);
  EXPECT_EQ(simulator.speed(), 1);
  for (std::size_t i = 1; i < simulator.size(); ++i) {
    EXPECT_NEAR(simulator.truth().stamps[i], 0.1 * static_cast<double>(i), 1e-12);
    const auto gap = pcl6d::distanceBetween(simulator.scanPose(i - 1, 0.1),
                                            simulator.scanPose(i, 0));
    EXPECT_LT(gap.translation, 1e-9);
    EXPECT_LT(gap.rotation, 1e-7);
  }
}

TEST(SimulatorOnTheMove, IsWhereItsPoseSaysAlsoWhenItStops)
{
  SimulationOptions options;
  options.num_scans = 10;
  const Simulator stops(pcl6d::builtInScene("corridor"), options);
  for (std::size_t i = 0; i < 10; ++i) {
    const Eigen::Isometry3d truth = stops.sceneFromWorld() * stops.truth().poses[i];
    for (const double time : {0.0, 2.0, 4.79}) // within a scan of 4.8 s
      EXPECT_LT(
          pcl6d::distanceBetween(truth, stops.poseAt(stops.truth().stamps[i] + time))
              .translation,
          1e-9);
  }
  // Half the way to the next scan.
  const double middle = (stops.truth().stamps[0] + 4.8 + stops.truth().stamps[1]) / 2;
  const auto step = [&](std::size_t i) {
    return (stops.poseAt(middle).translation() -
            (stops.sceneFromWorld() * stops.truth().poses[i]).translation())
        .norm();
  };
  EXPECT_NEAR(step(0), step(1), 0.1);
  EXPECT_GT(step(0), 1);
}

TEST(SimulatorOnTheMove, RefusesDrivesThatCannotBe)
{
  const auto refused = [](const auto& spoil, const std::string& words) {
    auto options = sweeping();
    spoil(options);
    try {
      Simulator(pcl6d::builtInScene("corridor"), options);
      ADD_FAILURE() << "no error with " << words;
    } catch (const pcl6d::BadArgument& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  refused([](auto& o) { o.period = 4; }, "period = 4, but must be at least 4.8");
  refused([](auto& o) { o.period = -1; }, "period = -1");
  refused([](auto& o) { o.turn_rate = 0; }, "turn_rate = 0");
  refused([](auto& o) { o.vibration = 0.2; }, "vibration = 0.2");
  const auto standing = [&](auto spoil) {
    refused(
        [&](auto& o) {
          o.motion = ScanMotion::kStop;
          spoil(o);
        },
        "with a stop for each scan");
  };
  standing([](auto& o) { o.period = 9; });
  standing([](auto& o) { o.turn_rate = 1; });
  standing([](auto& o) { o.turns_in_place = true; });
  standing([](auto& o) { o.vibration = 0.001; });
}
