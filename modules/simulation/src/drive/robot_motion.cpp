// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/robot_motion.h>

#include <array>
#include <cmath>

namespace pcl6d {
namespace {
constexpr double kKnotSpacing = 0.1; // [m] at most
constexpr double kTopSpeed = 50;     // [m/s]

// Weights of the four control points around the place u in [0, 1) between the second
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
} // namespace

RobotMotion::RobotMotion(const RobotPath& path, const RayCaster& caster, double speed)
{
  require(speed > 0 && speed <= kTopSpeed, "speed", speed, "in (0, 50] m/s");
  const double length = path.length();
  const auto count = static_cast<std::size_t>(std::ceil(length / kKnotSpacing));
  knots_per_second_ = speed * static_cast<double>(count) / length;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = length * static_cast<double>(i) / static_cast<double>(count);
    const Eigen::Isometry3d pose = path.sensorPose(caster, s);
    Eigen::Quaterniond q(pose.linear());
    if (i > 0 && q.dot(rotations_.back()) < 0)
      q.coeffs() *= -1;
    positions_.push_back(pose.translation());
    rotations_.push_back(q);
  }
}

Eigen::Isometry3d
RobotMotion::poseAt(double time) const
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
    // A round may end on the other side of the sphere of quaternions.
    const double side = rotation.dot(rotations_[i].coeffs()) < 0 ? -1 : 1;
    rotation += side * weights[k] * rotations_[i].coeffs();
  }
  Eigen::Isometry3d T_scene_sensor = Eigen::Isometry3d::Identity();
  T_scene_sensor.linear() =
      Eigen::Quaterniond(rotation.normalized()).toRotationMatrix();
  T_scene_sensor.translation() = position;
  return T_scene_sensor;
}

} // namespace pcl6d
