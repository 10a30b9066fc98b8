// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/plane_sums.h>

namespace pcl6d {

namespace {
/** Moves the origin of the twist by an offset: a becomes (n, a_x - offset x n). */
void
moveOrigin(PlaneSums& sums, const Eigen::Vector3d& offset)
{
  PlaneSums::Matrix L = PlaneSums::Matrix::Identity();
  L.bottomLeftCorner<3, 3>() = -skew(offset);
  sums.A = (L * sums.A * L.transpose()).eval();
  sums.b = (L * sums.b).eval();
}
} // namespace

Eigen::Matrix3d
planeToPlane(const Eigen::Vector3d& n, const Eigen::Vector3d& m, double epsilon)
{
  // In the directions n + m and n - m, which are orthogonal, the sum of the covariances
  // 2 I - k (n n^T + m m^T), k = 1 - epsilon, has the values 2 - k (1 +- c); 2 elsewhere.
  const double k = 1 - epsilon, c = n.dot(m);
  const Eigen::Vector3d sum = n + m, difference = n - m;
  const double along_sum = k / (4 * (2 - k * (1 + c)));
  const double along_difference = k / (4 * (2 - k * (1 - c)));
  return 2 * epsilon *
         (0.5 * Eigen::Matrix3d::Identity() + along_sum * sum * sum.transpose() +
          along_difference * difference * difference.transpose());
}

PlaneSums
PlaneSums::merge(const PlaneSums& a, const PlaneSums& b)
{
  if (a.count == 0)
    return b;
  if (b.count == 0)
    return a;
  const Eigen::Vector3d distance = b.mean_source - a.mean_source;
  const double share = b.weight / (a.weight + b.weight);
  PlaneSums sum = a, other = b;
  moveOrigin(sum, share * distance);
  moveOrigin(other, (share - 1) * distance);
  sum.count += b.count;
  sum.weight += b.weight;
  sum.mean_source += share * distance;
  sum.A += other.A;
  sum.b += other.b;
  sum.residual_sq += b.residual_sq;
  sum.distance_sq += b.distance_sq;
  sum.scatter += b.scatter + a.weight * share * distance * distance.transpose();
  return sum;
}

void
PlaneAccumulator::add(const Eigen::Vector3d& source,
                      const Eigen::Vector3d& target,
                      const Eigen::Vector3d& normal,
                      double weight)
{
  const double length = normal.norm();
  if (!source.allFinite() || !target.allFinite() || !normal.allFinite() || length == 0)
    return;
  if (sums_.count == 0)
    origin_ = source;
  const Eigen::Vector3d n = normal / length;
  const Eigen::Vector3d d = source - origin_;
  const double residual = n.dot(target - source);
  Twist a;
  a << n, d.cross(n);
  ++sums_.count;
  sums_.weight += weight;
  sums_.mean_source += weight * d;
  sums_.A += (weight * a) * a.transpose();
  sums_.b += (weight * residual) * a;
  sums_.residual_sq += weight * residual * residual;
  sums_.distance_sq += weight * (target - source).squaredNorm();
  sums_.scatter += weight * d * d.transpose();
}

void
PlaneAccumulator::addNorm(const Eigen::Vector3d& source,
                          const Eigen::Vector3d& target,
                          const Eigen::Matrix3d& N,
                          double weight)
{
  if (!source.allFinite() || !target.allFinite() || !N.allFinite())
    return;
  if (sums_.count == 0)
    origin_ = source;
  const Eigen::Vector3d d = source - origin_;
  const Eigen::Vector3d e = target - source;
  const Eigen::Matrix3d W = weight * N;
  const Eigen::Vector3d We = W * e;
  const Eigen::Matrix3d P = skew(d); // J = (I, -P)
  const Eigen::Matrix3d PW = P * W;
  ++sums_.count;
  sums_.weight += weight;
  sums_.mean_source += weight * d;
  sums_.A.topLeftCorner<3, 3>() += W;
  sums_.A.bottomLeftCorner<3, 3>() += PW;
  sums_.A.topRightCorner<3, 3>() += PW.transpose();
  sums_.A.bottomRightCorner<3, 3>() -= PW * P;
  sums_.b.head<3>() += We;
  sums_.b.tail<3>() += d.cross(We);
  sums_.residual_sq += e.dot(We);
  sums_.distance_sq += weight * e.squaredNorm();
  sums_.scatter += weight * d * d.transpose();
}

PlaneSums
PlaneAccumulator::sums() const
{
  PlaneSums sums = sums_;
  if (sums.count == 0)
    return sums;
  const Eigen::Vector3d mean = sums.mean_source / sums.weight;
  moveOrigin(sums, mean);
  sums.mean_source = origin_ + mean;
  sums.scatter -= sums.weight * mean * mean.transpose();
  return sums;
}

} // namespace pcl6d
