// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/simulation/robot_motion.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::RayCaster;
using pcl6d::RobotMotion;
using pcl6d::RobotPath;

constexpr double kSpeed = 0.5; // [m/s]

// A stair along x, up from x = 0 and down again behind a landing, 6 m wide.
constexpr double kTread = 0.28; // [m]
constexpr double kRiser = 0.17; // [m]
constexpr int kSteps = 8;

double
stairHeight(double x)
{
  const double top = kSteps * kTread;
  const double from_edge = x < top + 1 ? x : 2 * top + 2 - x;
  const double steps = std::floor(from_edge / kTread) + 1;
  return kRiser * std::min<double>(kSteps, std::max(0.0, steps));
}

RayCaster
stair()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-10, -10, -1}, {20, 10, 0}, {"floor", 0.5});
  const double end = 2 * kSteps * kTread + 2;
  for (int i = 0; i < kSteps; ++i)
    pcl6d::addBox(scene,
                  {i * kTread, -3, -0.5},
                  {end - i * kTread, 3, (i + 1) * kRiser},
                  {"step", 0.5});
  return RayCaster(scene);
}

// Over the stair and back beside it.
std::vector<Eigen::Vector3d>
overTheStair()
{
  std::vector<Eigen::Vector3d> way;
  for (double x = -4; x <= 11; x += 0.25)
    way.emplace_back(x, 0, stairHeight(x));
  for (const auto& [x, y] : {std::pair{13, 0}, {13, 6}, {-6, 6}, {-6, 0}})
    way.emplace_back(x, y, 0);
  return way;
}

// At kSpeed, without further wishes.
pcl6d::MotionOptions
ride()
{
  pcl6d::MotionOptions options;
  options.speed = kSpeed;
  return options;
}

double
pitchUp(const Eigen::Isometry3d& pose)
{
  return -pcl6d::eulerFromRotation(pose.linear()).pitch;
}
} // namespace

TEST(RobotMotion, StaysByThePathOfTheCorridor)
{
  const auto scene = pcl6d::builtInScene("corridor");
  const RayCaster caster(scene.geometry);
  const RobotPath path(scene.waypoints, {});
  const RobotMotion motion(path, caster, ride());
  for (double s = 0; s < path.length(); s += 0.77) {
    const Eigen::Isometry3d pose = motion.poseAt(s / kSpeed);
    const auto error = pcl6d::distanceBetween(path.sensorPose(caster, s), pose);
    EXPECT_TRUE(pcl6d::isRigid(pose, 1e-12));
    EXPECT_LT(error.translation, 0.01) << "s = " << s;
    EXPECT_LT(error.rotation, 2 * M_PI / 180) << "s = " << s; // where a ramp begins
  }
}

TEST(RobotMotion, IsThePathWhereThatIsStraightAndFlat)
{
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const RobotMotion motion(path, caster, ride());
  for (double s = 1; s < 2; s += 0.13) { // ahead of the stair
    const auto error =
        pcl6d::distanceBetween(path.sensorPose(caster, s), motion.poseAt(s / kSpeed));
    EXPECT_LT(error.translation, 1e-4); // the way is measured along chords
    EXPECT_LT(error.rotation, 1e-9);
  }
}

// Twice differentiable: where a pose jumped by d, the second difference would be d, and
// where a velocity jumped by v, v h.
TEST(RobotMotion, IsSmoothInTimeAlsoOverStairs)
{
  const RobotMotion motion(RobotPath(overTheStair(), {}), stair(), ride());
  constexpr double h = 1e-3; // [s]
  // Knots are 0.1 m apart: a jump of 0.17 m of a wheel moves the sensor by at most that,
  // over 0.2 s, and the largest second derivative of the weights is 2 per knot.
  constexpr double kMostAcceleration = 2 * 2 * 0.3 * 25; // [m/s^2]
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (double time = 0; time < 80; time += h) {
    const Eigen::Isometry3d a = motion.poseAt(time - h);
    const Eigen::Isometry3d b = motion.poseAt(time);
    const Eigen::Isometry3d c = motion.poseAt(time + h);
    const Eigen::Vector3d acceleration =
        (a.translation() - 2 * b.translation() + c.translation()) / (h * h);
    ASSERT_LT(acceleration.norm(), kMostAcceleration) << "time " << time;
    const double turn = (a.linear() - 2 * b.linear() + c.linear()).norm() / (h * h);
    ASSERT_LT(turn, 200) << "time " << time; // [1/s^2]
    // It changes evenly, too: no jump of 5 m/s^2 within a millisecond.
    if (time > 0) {
      ASSERT_LT((acceleration - last).norm(), 5) << "time " << time;
    }
    last = acceleration;
  }
}

TEST(RobotMotion, PitchesOnStairs)
{
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const RobotMotion motion(path, caster, ride());
  const double slope = std::atan2(kRiser, kTread);
  double sum = 0;
  int count = 0;
  double top = 0;
  for (double time = 0; time < 40; time += 0.01) {
    const Eigen::Isometry3d pose = motion.poseAt(time);
    const double x = pose.translation().x();
    const double y = pose.translation().y();
    top = std::max(top, pose.translation().z());
    if (std::abs(y) > 0.1)
      continue;
    EXPECT_LT(std::abs(pitchUp(pose)), 0.75) << "x = " << x; // 43 deg
    // Where both wheels are on the way up.
    if (x > 0.6 && x < (kSteps - 1) * kTread - 0.6) {
      EXPECT_GT(pitchUp(pose), 0.25) << "x = " << x;
      sum += pitchUp(pose);
      ++count;
    }
  }
  ASSERT_GT(count, 0);
  EXPECT_NEAR(sum / count, slope, 0.12); // 31 deg
  EXPECT_NEAR(top, kSteps * kRiser + 0.9, 0.15);
}

TEST(RobotMotion, GoesRoundAndRound)
{
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const RobotMotion motion(path, caster, ride());
  const double round = path.length() / kSpeed;
  for (const double time : {0.0, 3.3, 20.0}) {
    for (const double turns : {1, 2, -1}) {
      const auto error = pcl6d::distanceBetween(motion.poseAt(time),
                                                motion.poseAt(time + turns * round));
      EXPECT_LT(error.translation, 1e-9);
      EXPECT_LT(error.rotation, 1e-9);
    }
  }
  const auto step =
      pcl6d::distanceBetween(motion.poseAt(round - 1e-6), motion.poseAt(1e-6));
  EXPECT_LT(step.translation, 1e-5);
  EXPECT_LT(step.rotation, 1e-5);
}

namespace {
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
onTheSquare(pcl6d::PathCorners corners, const pcl6d::MotionOptions& options)
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
  pcl6d::MotionOptions options = ride();
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
  pcl6d::MotionOptions options = ride();
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
  pcl6d::MotionOptions options = ride();
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
  const auto caster = stair();
  const RobotPath path(overTheStair(), {});
  const auto refused = [&](const auto& spoil) {
    pcl6d::MotionOptions options = ride();
    spoil(options);
    EXPECT_THROW(RobotMotion(path, caster, options), pcl6d::BadArgument);
  };
  for (const double speed : {0.0, -1.0, 50.1, std::nan("")})
    refused([&](auto& options) { options.speed = speed; });
  for (const double rate : {0.0, -1.0, 10.1, std::nan("")})
    refused([&](auto& options) { options.turn_rate = rate; });
  for (const double vibration : {-0.001, 0.11, std::nan("")})
    refused([&](auto& options) { options.vibration = vibration; });
  EXPECT_THROW(onTheSquare(pcl6d::PathCorners::kSharp, ride()), pcl6d::BadArgument)
      << "no turn rate for the corners";
  EXPECT_THROW(pcl6d::PoseSpline({}, 1), pcl6d::BadArgument);
}
