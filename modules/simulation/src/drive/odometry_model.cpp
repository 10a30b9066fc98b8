// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/simulation/odometry_model.h>

#include <cmath>
#include <utility>

namespace pcl6d {
namespace {
// Rz of the yaw of R; without sine or arc tangent, and without -0, which would appear
// in the written file.
Eigen::Matrix3d
yawOnly(const Eigen::Matrix3d& R)
{
  const Eigen::Vector2d heading = R.block<2, 1>(0, 0).normalized();
  Eigen::Matrix3d yaw;
  yaw << heading.x(), 0 - heading.y(), 0, heading.y(), heading.x(), 0, 0, 0, 1;
  return yaw;
}

Eigen::Isometry3d
planarPart(const Eigen::Isometry3d& pose)
{
  Eigen::Isometry3d planar = Eigen::Isometry3d::Identity();
  planar.linear() = yawOnly(pose.linear());
  planar.translation().head<2>() = pose.translation().head<2>();
  return planar;
}

Eigen::Isometry3d
disturbed(Eigen::Isometry3d motion, const OdometryOptions& options, Random& random)
{
  const double way = motion.translation().norm();
  const double spread = std::sqrt(way);
  motion.translation().head<2>() *= 1 + options.scale_error;
  for (int axis = 0; axis < 2; ++axis)
    motion.translation()[axis] += options.translation_noise * spread * random.normal();
  const double turn = portableAtan2(motion.linear()(1, 0), motion.linear()(0, 0));
  const auto [s, c] =
      portableSinCos(options.turn_scale_error * turn + options.yaw_bias * way +
                     options.yaw_noise * spread * random.normal());
  Eigen::Matrix3d error;
  error << c, -s, 0, s, c, 0, 0, 0, 1;
  motion.linear() = motion.linear() * error;
  return motion;
}
} // namespace

void
OdometryOptions::validate() const
{
  require(std::abs(scale_error) < 1, "scale_error", scale_error, "in (-1, 1)");
  require(std::abs(yaw_bias) < 1, "yaw_bias", yaw_bias, "in (-1, 1)");
  require(translation_noise >= 0 && translation_noise < 1,
          "translation_noise",
          translation_noise,
          "in [0, 1)");
  require(yaw_noise >= 0 && yaw_noise < 1, "yaw_noise", yaw_noise, "in [0, 1)");
  require(std::abs(turn_scale_error) < 1,
          "turn_scale_error",
          turn_scale_error,
          "in (-1, 1)");
}

void
VisualInertialOptions::validate() const
{
  require(std::abs(scale_error) < 1, "scale_error", scale_error, "in (-1, 1)");
  require(std::abs(yaw_bias) < 1, "yaw_bias", yaw_bias, "in (-1, 1)");
  for (const auto& [name, value] : {std::pair{"translation_noise", translation_noise},
                                    std::pair{"yaw_noise", yaw_noise},
                                    std::pair{"tilt_noise", tilt_noise}})
    require(value >= 0 && value < 1, name, value, "in [0, 1)");
  require(tilt_way > 0 && std::isfinite(tilt_way), "tilt_way", tilt_way, "> 0");
}

Trajectory
wheelOdometry(const Trajectory& truth,
              const OdometryOptions& options,
              std::uint64_t seed)
{
  options.validate();
  Trajectory odometry;
  odometry.stamps = truth.stamps;
  Random random(mixBits(seed));
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    if (i == 0) {
      odometry.poses.push_back(planarPart(truth.poses[0]));
      continue;
    }
    const Eigen::Isometry3d motion = truth.poses[i - 1].inverse() * truth.poses[i];
    Eigen::Isometry3d next =
        odometry.poses.back() * disturbed(planarPart(motion), options, random);
    next.linear() = yawOnly(next.linear()); // rounding must not add up
    odometry.poses.push_back(next);
  }
  return odometry;
}

namespace {
// Attitude error of an inertial unit.
class AttitudeError {
public:
  AttitudeError(const VisualInertialOptions& options, Random& random)
  : options_(options), random_(random)
  {}

  // Advances by a way [m].
  void
  advance(double way)
  {
    yaw_ += options_.yaw_bias * way +
            options_.yaw_noise * std::sqrt(way) * random_.normal();
    // Gauss-Markov: the old error fades, the added noise keeps its variance.
    const double kept = options_.tilt_way / (options_.tilt_way + way);
    const double added = options_.tilt_noise * std::sqrt(1 - kept * kept);
    for (double* tilt : {&tilt_.x(), &tilt_.y()})
      *tilt = kept * *tilt + added * random_.normal();
  }

  Eigen::Matrix3d
  appliedTo(const Eigen::Matrix3d& R) const
  {
    return rotationFromVector({0, 0, yaw_}) * R *
           rotationFromVector({tilt_.x(), tilt_.y(), 0});
  }

private:
  const VisualInertialOptions& options_;
  Random& random_;
  double yaw_ = 0;                                 // [rad]
  Eigen::Vector2d tilt_ = Eigen::Vector2d::Zero(); // [rad] roll, pitch
};
} // namespace

Trajectory
visualInertialOdometry(const Trajectory& truth,
                       const VisualInertialOptions& options,
                       std::uint64_t seed)
{
  options.validate();
  Trajectory odometry;
  odometry.stamps = truth.stamps;
  Random random(mixBits(seed));
  AttitudeError error(options, random);
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    if (i == 0) {
      odometry.poses.push_back(truth.poses[0]);
      continue;
    }
    Eigen::Vector3d step =
        (truth.poses[i - 1].inverse() * truth.poses[i]).translation();
    const double way = step.norm();
    step *= 1 + options.scale_error;
    for (int axis = 0; axis < 3; ++axis)
      step[axis] += options.translation_noise * std::sqrt(way) * random.normal();
    Eigen::Isometry3d next = odometry.poses.back();
    next.translation() += next.linear() * step;
    error.advance(way);
    next.linear() = error.appliedTo(truth.poses[i].linear());
    odometry.poses.push_back(next);
  }
  return odometry;
}

} // namespace pcl6d
