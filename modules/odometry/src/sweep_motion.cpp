// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_motion.h"

#include <pcl6d/common/parallel.h>

namespace pcl6d::odometry {

namespace {
/** [rad^2] Up to this turn within a sweep the series below have an error of less than 1e-9. */
constexpr double kSeriesTurn_sq = 0.8;

constexpr std::size_t kPlacesPerBlock = 1024;
} // namespace

/** motionFromTwist() by the series of its three functions: no trigonometric call per point. */
Eigen::Vector3d
SweepMotion::place(const SweepPoint& measured) const
{
  const Eigen::Vector3d p = measured.point.cast<double>();
  if (measured.share == 0)
    return begin * p;
  const Twist twist = twistAt(measured.share);
  const Eigen::Vector3d b = twist.head<3>(), x = twist.tail<3>();
  const double n = x.squaredNorm();
  if (n > kSeriesTurn_sq)
    return begin * (motionFromTwist(twist) * p);
  // sin n / n, (1 - cos n) / n^2, (n - sin n) / n^3
  const double s = 1 - n / 6 * (1 - n / 20 * (1 - n / 42 * (1 - n / 72)));
  const double c = 0.5 * (1 - n / 12 * (1 - n / 30 * (1 - n / 56 * (1 - n / 90))));
  const double d = (1 - n / 20 * (1 - n / 42 * (1 - n / 72 * (1 - n / 110)))) / 6;
  const Eigen::Vector3d xp = x.cross(p), xb = x.cross(b);
  const Eigen::Vector3d moved = p + b + s * xp + c * xb + x.cross(c * xp + d * xb);
  return begin * moved;
}

Twist
SweepMotion::offsetAt(double share) const
{
  const SweepPart at(share, kSweepParts);
  return (1 - at.share) * offsets[at.part] + at.share * offsets[at.part + 1];
}

SweepMotion
reversed(const SweepMotion& motion)
{
  SweepMotion back = motion;
  back.begin = motion.end();
  back.velocity = -motion.velocity;
  std::reverse(back.offsets.begin(), back.offsets.end());
  return back;
}

std::vector<Eigen::Vector3d>
placesOf(const SweepPoints& points, const SweepMotion& motion, unsigned int num_threads)
{
  std::vector<Eigen::Vector3d> places(points.size());
  parallelBlocks(points.size(), kPlacesPerBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      places[i] = motion.place(points[i]);
  });
  return places;
}

/** A motion (xb, x) about `from` is (xb + x x (to - from), x) about `to`. */
Eigen::Matrix<double, 12, 12>
movedCovariance(const Eigen::Matrix<double, 12, 12>& covariance,
                const Eigen::Vector3d& from,
                const Eigen::Vector3d& to)
{
  Eigen::Matrix<double, 12, 12> there = Eigen::Matrix<double, 12, 12>::Identity();
  there.block<3, 3>(0, 3) = there.block<3, 3>(6, 9) = -skew(to - from);
  return there * covariance * there.transpose();
}

} // namespace pcl6d::odometry
