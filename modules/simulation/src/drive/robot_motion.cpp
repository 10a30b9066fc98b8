// SPDX-License-Identifier: BSD-3-Clause
#include "drive/timetable.h"
#include "drive/vibration.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/robot_motion.h>

#include <array>
#include <cmath>

namespace pcl6d {
using simulation::Timetable;
using simulation::Vibration;

namespace {
constexpr double kKnotSpacing = 0.1; // [m] at most
constexpr double kKnotTime = 0.1;    // [s] at most, where the robot slows down
constexpr double kShakeTime = 0.1 / simulation::kHighestShake; // [s] ten in a wave
constexpr double kMostKnots = 1e6;                             // 200 MB
constexpr double kTopSpeed = 50;                               // [m/s]

// Weights of the four control points around the position u in [0, 1) between the second
// and the third.
std::array<double, 4>
cubicWeights(double u)
{
  const double v = 1 - u;
  return {v * v * v / 6,
          (3 * u * u * u - 6 * u * u + 4) / 6,
          (3 * v * v * v - 6 * v * v + 4) / 6,
          u * u * u / 6};
}

// Number of steps of a round, with a largest step length.
std::size_t
stepsOf(double round, double longest)
{
  require(round <= kMostKnots * longest,
          "time of one round",
          round,
          "at most " + std::to_string(kMostKnots * longest) + " s");
  return static_cast<std::size_t>(std::ceil(round / longest));
}

std::vector<Eigen::Isometry3d>
posesEvenly(const RobotPath& path, const RayCaster& caster)
{
  const auto count = static_cast<std::size_t>(std::ceil(path.length() / kKnotSpacing));
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < count; ++i)
    poses.push_back(path.sensorPose(
        caster, path.length() * static_cast<double>(i) / static_cast<double>(count)));
  return poses;
}

std::vector<Eigen::Isometry3d>
posesByTimetable(const RobotPath& path,
                 const RayCaster& caster,
                 const Timetable& timetable,
                 double speed)
{
  const std::size_t count =
      stepsOf(timetable.duration(), std::min(kKnotTime, kKnotSpacing / speed));
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const auto now = timetable.at(timetable.duration() * static_cast<double>(i) /
                                  static_cast<double>(count));
    const SinCos heading = portableSinCos(now.heading);
    poses.push_back(path.sensorPose(caster, now.way, {heading.cos, heading.sin}));
  }
  return poses;
}

std::vector<Eigen::Isometry3d>
shaken(const PoseSpline& spline,
       double round,
       double lever,
       const RobotMotionOptions& options)
{
  const auto count = static_cast<double>(stepsOf(round, kShakeTime));
  const double step = round / count;
  const Vibration vibration(options.vibration, lever, round, step, options.seed);
  std::vector<Eigen::Isometry3d> poses;
  for (double i = 0; i < count; ++i)
    poses.push_back(spline.poseAt(i * step) * vibration.at(i * step));
  return poses;
}
} // namespace

void
RobotMotionOptions::validate() const
{
  require(speed > 0 && speed <= kTopSpeed, "speed", speed, "in (0, 50] m/s");
  require(!turn_rate || (*turn_rate > 0 && *turn_rate <= 10),
          "turn_rate",
          turn_rate.value_or(0),
          "in (0, 10] rad/s");
  require(vibration >= 0 && vibration <= 0.1, "vibration", vibration, "in [0, 0.1] m");
}

PoseSpline::PoseSpline(const std::vector<Eigen::Isometry3d>& poses,
                       double knots_per_second)
: knots_per_second_(knots_per_second)
{
  require(!poses.empty(), "number of poses", poses.size(), ">= 1");
  for (const auto& pose : poses) {
    Eigen::Quaterniond q(pose.linear());
    if (!rotations_.empty() && q.dot(rotations_.back()) < 0)
      q.coeffs() *= -1;
    positions_.push_back(pose.translation());
    rotations_.push_back(q);
  }
}

Eigen::Isometry3d
PoseSpline::poseAt(double time) const
{
  const auto count = static_cast<double>(positions_.size());
  double knot = time * knots_per_second_;
  knot -= std::floor(knot / count) * count;
  const double before = std::floor(knot);
  const auto weights = cubicWeights(knot - before);
  const auto last = positions_.size() - 1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector4d rotation = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t i = (static_cast<std::size_t>(before) + last + k) % (last + 1);
    position += weights[k] * positions_[i];
    // A round may end on the opposite side of the quaternion sphere.
    const double side = rotation.dot(rotations_[i].coeffs()) < 0 ? -1 : 1;
    rotation += side * weights[k] * rotations_[i].coeffs();
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(rotation.normalized()).toRotationMatrix();
  pose.translation() = position;
  return pose;
}

RobotMotion::RobotMotion(const RobotPath& path,
                         const RayCaster& caster,
                         const RobotMotionOptions& options)
{
  options.validate();
  require(options.turn_rate || path.corners().empty(),
          "corners of the path",
          path.corners().size(),
          "rounded: no turn rate is given");
  std::vector<Eigen::Isometry3d> poses;
  if (options.turn_rate) {
    const Timetable timetable(path, options.speed, *options.turn_rate);
    duration_ = timetable.duration();
    poses = posesByTimetable(path, caster, timetable, options.speed);
    spline_.emplace(poses, static_cast<double>(poses.size()) / duration_);
  }
  else {
    duration_ = path.length() / options.speed;
    poses = posesEvenly(path, caster);
    spline_.emplace(poses,
                    options.speed * static_cast<double>(poses.size()) / path.length());
  }
  if (options.vibration > 0) {
    poses = shaken(*spline_, duration_, path.robot().wheel_base, options);
    spline_.emplace(poses, static_cast<double>(poses.size()) / duration_);
  }
}

} // namespace pcl6d
