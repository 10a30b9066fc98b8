// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/pair_moments.h"

#include <pcl6d/common/rotation.h>

#include <algorithm>

namespace pcl6d::graph_relaxation {

namespace {
/** \return [I | c | -[c]x] */
Eigen::Matrix<double, 3, 7>
motionMatrix(const Eigen::Vector3d& c)
{
  Eigen::Matrix<double, 3, 7> M;
  M << Eigen::Matrix3d::Identity(), c, -skew(c);
  return M;
}

/** A, b and the rest of pairs without norms: all of it follows from the moments. */
void
fillFromMoments(LinkSums& sums)
{
  const double squares = sums.scatter.trace();
  sums.A.topLeftCorner<3, 3>().diagonal().setConstant(sums.weight);
  sums.A(3, 3) = squares;
  sums.A.bottomRightCorner<3, 3>() =
      squares * Eigen::Matrix3d::Identity() - sums.scatter;
  const Eigen::Matrix3d& C = sums.cross;
  sums.b << sums.weight * sums.mean_z, C.trace(), C(1, 2) - C(2, 1), C(2, 0) - C(0, 2),
      C(0, 1) - C(1, 0);
  sums.residual_sq = sums.spread.trace() + sums.weight * sums.mean_z.squaredNorm();
}
} // namespace

void
PairMoments::add(const Eigen::Vector3d& c, const Eigen::Vector3d& Z, double w)
{
  Vector6 p;
  p << c, Z;
  const Vector6 wp = w * p;
  ++count;
  weight += w;
  weight_sq += w * w;
  first += wp;
  second.noalias() += wp * p.transpose();
}

void
PairMoments::addNorm(const Eigen::Vector3d& c,
                     const Eigen::Vector3d& Z,
                     const Eigen::Matrix3d& W)
{
  const double tr = W.trace(), tr_sq = W.squaredNorm();
  if (!(tr > 0))
    return;
  add(c, Z, tr_sq / tr);
  has_norms = true;
  trace += tr;
  trace_sq += tr_sq;
  const Eigen::Matrix<double, 3, 7> M = motionMatrix(c);
  const Eigen::Matrix<double, 3, 7> WM = W * M;
  A.noalias() += M.transpose() * WM;
  b.noalias() += WM.transpose() * Z;
  residual_sq += Z.dot(W * Z);
}

PairMoments
PairMoments::merge(const PairMoments& a, const PairMoments& b)
{
  PairMoments sum = a;
  sum.count += b.count;
  sum.weight += b.weight;
  sum.weight_sq += b.weight_sq;
  sum.first += b.first;
  sum.second += b.second;
  sum.has_norms = a.has_norms || b.has_norms;
  sum.trace += b.trace;
  sum.trace_sq += b.trace_sq;
  sum.A += b.A;
  sum.b += b.b;
  sum.residual_sq += b.residual_sq;
  return sum;
}

LinkSums
PairMoments::about(const Eigen::Vector3d& origin) const
{
  LinkSums sums;
  if (count == 0)
    return sums;
  const Vector6 mean = first / weight;
  const Matrix6 central = second - weight * mean * mean.transpose();
  const Eigen::Vector3d shift = mean.head<3>();
  sums.count = count;
  sums.weight = weight;
  sums.centre = origin + shift;
  sums.mean_z = mean.tail<3>();
  sums.scatter = central.topLeftCorner<3, 3>();
  sums.cross = central.topRightCorner<3, 3>();
  sums.spread = central.bottomRightCorner<3, 3>();
  if (!has_norms) {
    sums.equations = 3 * weight * weight / weight_sq;
    fillFromMoments(sums);
    return sums;
  }
  // M about the mean is M about the origin times L.
  LinkSums::Matrix L = LinkSums::Matrix::Identity();
  L.topRightCorner<3, 4>() = -motionMatrix(shift).rightCols<4>();
  sums.equations = trace * trace / trace_sq;
  sums.A = L.transpose() * A * L;
  sums.b = L.transpose() * b;
  sums.residual_sq = residual_sq;
  return sums;
}

} // namespace pcl6d::graph_relaxation
