// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/twist.h>

namespace pcl6d {

namespace {
/** (n - sin n) / n^3, by series where the difference would cancel. */
double
sineDefect(double n)
{
  const double n2 = n * n;
  if (n < 0.1)
    return (1 - n2 / 20 * (1 - n2 / 42 * (1 - n2 / 72))) / 6;
  return (n - portableSinCos(n).sin) / (n * n2);
}

/** (1 - cos n) / n^2 */
double
cosineDefect(double n)
{
  if (n < 1e-8)
    return 0.5;
  const double half_sine = portableSinCos(0.5 * n).sin / n;
  return 2 * half_sine * half_sine;
}
} // namespace

Eigen::Isometry3d
motionFromTwist(const Twist& twist)
{
  const Eigen::Vector3d xb = twist.head<3>(), x = twist.tail<3>();
  const double n = x.norm();
  const Eigen::Vector3d turned = x.cross(xb);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotationFromVector(x);
  T.translation() = xb + cosineDefect(n) * turned + sineDefect(n) * x.cross(turned);
  return T;
}

Twist
twistFromMotion(const Eigen::Isometry3d& motion)
{
  // V^-1 = I - [x]x / 2 + q [x]x^2, where q = (1 - n/2 cot(n/2)) / n^2.
  const Eigen::Vector3d x = rotationVector(motion.linear());
  const double n = x.norm();
  double q = 1.0 / 12 + n * n / 720;
  if (n > 1e-2) {
    const auto [sine, cosine] = portableSinCos(0.5 * n);
    q = (1 - 0.5 * n * cosine / sine) / (n * n);
  }
  const Eigen::Vector3d& t = motion.translation();
  Twist twist;
  twist << t - 0.5 * x.cross(t) + q * x.cross(x.cross(t)), x;
  return twist;
}

Eigen::Matrix3d
eulerRates(const EulerAngles& angles)
{
  const auto [sp, cp] = portableSinCos(angles.pitch);
  const auto [sy, cy] = portableSinCos(angles.yaw);
  Eigen::Matrix3d J;
  J << cy * cp, -sy, 0, sy * cp, cy, 0, -sp, 0, 1;
  return J;
}

} // namespace pcl6d
