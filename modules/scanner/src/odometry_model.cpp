// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/scanner/odometry_model.h>

#include <cmath>

namespace pcl6d {
namespace {
// Rz of the yaw of R; without sine or arc tangent, and without -0, which would show in
// the written file.
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
  const auto [s, c] = portableSinCos(options.yaw_bias * way +
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

} // namespace pcl6d
