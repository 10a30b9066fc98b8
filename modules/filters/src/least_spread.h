// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/simd_clones.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

/** \file
 * Direction of least spread of points, for one patch or several at once. */
namespace pcl6d::filters {

/** Ratio of squared spreads below which points count as lying on a line. */
constexpr double kLineTolerance = 1e-8;

/** The upper half of a symmetric matrix, of one patch or of a patch in each lane. */
template <typename Real>
struct Symmetric {
  Real xx, xy, xz, yy, yz, zz;
};

/** Number of patches at once: the operations for one patch, lane by lane. */
constexpr std::size_t kSpreadLanes = 8;
using SpreadLanes = double __attribute__((vector_size(8 * kSpreadLanes)));

/** Whether any lane is above a limit. */
PCL6D_INLINE bool
anyAbove(double value, double limit)
{
  return value > limit;
}
PCL6D_INLINE bool
anyAbove(const SpreadLanes& values, double limit)
{
  bool any = false;
  for (std::size_t lane = 0; lane < kSpreadLanes; ++lane)
    any |= values[lane] > limit;
  return any;
}

/** A scatter whose trace is 1, with the least of its eigenvalues. */
template <typename Real>
struct Spread {
  Symmetric<Real> S;
  Real trace; ///< before normalisation; the other members are valid only if > 0
  Real c1;    ///< of the characteristic polynomial
  Real root;
};

/** The smallest root of the characteristic polynomial is found by Newton's method from zero, where
 * it is increasing and concave: no step overshoots. */
template <typename Real>
PCL6D_INLINE Spread<Real>
spreadOf(const Symmetric<Real>& scatter)
{
  const Real trace = scatter.xx + (scatter.yy + scatter.zz);
  const Symmetric<Real> S = {scatter.xx / trace,
                             scatter.xy / trace,
                             scatter.xz / trace,
                             scatter.yy / trace,
                             scatter.yz / trace,
                             scatter.zz / trace};
  const Real c1 =
      S.xx * S.yy - S.xy * S.xy + S.xx * S.zz - S.xz * S.xz + S.yy * S.zz - S.yz * S.yz;
  const Real c0 = S.xx * (S.yy * S.zz - S.yz * S.yz) -
                  S.xy * (S.xy * S.zz - S.yz * S.xz) +
                  S.xz * (S.xy * S.yz - S.yy * S.xz);
  const Real none{};
  Real root{}, step = none + 1;
  for (int i = 0; i < 40 && anyAbove(step, 1e-15); ++i) {
    const Real value = ((root - 1) * root + c1) * root - c0;
    const Real slope = (3 * root - 2) * root + c1;
    const Real newton = -value / slope;
    const Real forward = slope > none ? (newton > none ? newton : none) : none;
    step = step > none + 1e-15 ? forward : none;
    root += step;
  }
  return {S, trace, c1, root};
}

/** The two larger squared spreads, as shares of the trace. */
struct OtherSpreads {
  double largest, product; ///< the second is their quotient
};

inline OtherSpreads
otherSpreads(const Spread<double>& of)
{
  const double others = 1 - of.root, product = of.c1 - of.root * others;
  return {(others + std::sqrt(std::max(0.0, others * others - 4 * product))) / 2,
          product};
}

/** \return the second standard deviation by the first, in [0, 1]; 0 of points in one place */
inline double
breadthOf(const Spread<double>& of)
{
  if (!(of.trace > 0))
    return 0;
  const OtherSpreads others = otherSpreads(of);
  return std::sqrt(std::max(0.0, others.product)) / others.largest;
}

/** \return the direction of least spread; zero for points on a line. This direction is orthogonal
 * to two rows of S - root. Several times as fast as a general solver, which handles the undecided
 * patches: nearly as thick as wide in a direction.
 * \param[in] line points lie on a line if their second largest squared spread is at most this share
 * of the largest */
inline Eigen::Vector3d
leastSpread(const Spread<double>& of, double line = kLineTolerance)
{
  if (!(of.trace > 0))
    return Eigen::Vector3d::Zero();
  const OtherSpreads others = otherSpreads(of);
  if (!(others.product > line * others.largest * others.largest))
    return Eigen::Vector3d::Zero();
  Eigen::Matrix3d S;
  S << of.S.xx, of.S.xy, of.S.xz, of.S.xy, of.S.yy, of.S.yz, of.S.xz, of.S.yz, of.S.zz;
  const Eigen::Matrix3d rest = S - of.root * Eigen::Matrix3d::Identity();
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d direction = rest.row(i).cross(rest.row((i + 1) % 3));
    if (direction.squaredNorm() > best.squaredNorm())
      best = direction;
  }
  if (best.squaredNorm() > 1e-8)
    return best.normalized();
  return symmetricEigen(S).vectors.col(0);
}

} // namespace pcl6d::filters
