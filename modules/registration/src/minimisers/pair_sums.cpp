// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pair_sums.h>

namespace pcl6d {

PairSums
PairSums::merge(const PairSums& a, const PairSums& b)
{
  if (a.count == 0)
    return b;
  if (b.count == 0)
    return a;
  PairSums sum;
  sum.count = a.count + b.count;
  sum.weight = a.weight + b.weight;
  const Eigen::Vector3d dd = b.mean_source - a.mean_source;
  const Eigen::Vector3d dm = b.mean_target - a.mean_target;
  const double share = b.weight / sum.weight;
  const double spread = a.weight * share; // W_a W_b / W
  sum.mean_source = a.mean_source + share * dd;
  sum.mean_target = a.mean_target + share * dm;
  sum.cross = a.cross + b.cross + spread * dd * dm.transpose();
  sum.scatter = a.scatter + b.scatter + spread * dd * dd.transpose();
  sum.target_sq = a.target_sq + b.target_sq + spread * dm.squaredNorm();
  return sum;
}

double
PairSums::errorSq(const Eigen::Isometry3d& T) const
{
  const double about_means = target_sq + sourceSq() - 2 * (T.linear() * cross).trace();
  const double of_means = weight * (mean_target - T * mean_source).squaredNorm();
  return std::max(0.0, about_means) + of_means;
}

void
PairAccumulator::add(const Eigen::Vector3d& source,
                     const Eigen::Vector3d& target,
                     double weight)
{
  if (!source.allFinite() || !target.allFinite())
    return;
  if (count_ == 0) {
    origin_source_ = source;
    origin_target_ = target;
  }
  ++count_;
  weight_ += weight;
  const Eigen::Vector3d d = source - origin_source_;
  const Eigen::Vector3d m = target - origin_target_;
  sum_source_ += weight * d;
  sum_target_ += weight * m;
  sum_cross_ += weight * d * m.transpose();
  sum_scatter_ += weight * d * d.transpose();
  sum_target_sq_ += weight * m.squaredNorm();
}

PairSums
PairAccumulator::sums() const
{
  PairSums sums;
  if (count_ == 0)
    return sums;
  const Eigen::Vector3d d = sum_source_ / weight_;
  const Eigen::Vector3d m = sum_target_ / weight_;
  sums.count = count_;
  sums.weight = weight_;
  sums.mean_source = origin_source_ + d;
  sums.mean_target = origin_target_ + m;
  sums.cross = sum_cross_ - weight_ * d * m.transpose();
  sums.scatter = sum_scatter_ - weight_ * d * d.transpose();
  sums.target_sq = sum_target_sq_ - weight_ * m.squaredNorm();
  return sums;
}

} // namespace pcl6d
