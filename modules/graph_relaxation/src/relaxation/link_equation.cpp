// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/link_equation.h"

#include <pcl6d/common/decompositions.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::graph_relaxation {

namespace {
/** Weight of the scale in a measurement, relative to the rest. */
constexpr double kScaleHold = 1e6;

/** A square root of B: scales motions to the motion of the points. */
template <int Size>
struct Whitening {
  using Matrix = Eigen::Matrix<double, Size, Size>;
  Matrix root = Matrix::Identity();    ///< B^1/2
  Matrix inverse = Matrix::Identity(); ///< B^-1/2
};

template <int Size>
Whitening<Size>
whiteningOf(const LinkSums& sums)
{
  constexpr double kThickness_sq = 0.01; // see kOpenDirection
  const double squares = sums.scatter.trace();
  const auto turning =
      symmetricEigen<3>(squares * Eigen::Matrix3d::Identity() - sums.scatter);
  const double largest = turning.values(2);
  const double least = largest > 0 ? kThickness_sq * largest : sums.weight;
  const Eigen::Vector3d sizes = turning.values.cwiseMax(least).cwiseSqrt();
  const Eigen::Matrix3d& V = turning.vectors;
  Whitening<Size> whitening;
  whitening.root *= std::sqrt(sums.weight);
  if (Size == 7)
    whitening.root(3, 3) = std::sqrt(squares > 0 ? squares : sums.weight);
  whitening.inverse.diagonal() = whitening.root.diagonal().cwiseInverse();
  whitening.root.template bottomRightCorner<3, 3>() =
      V * sizes.asDiagonal() * V.transpose();
  whitening.inverse.template bottomRightCorner<3, 3>() =
      V * sizes.cwiseInverse().asDiagonal() * V.transpose();
  return whitening;
}

template <int Size>
Eigen::Matrix<double, Size, Size>
matrixOf(const LinkSums& sums)
{
  if constexpr (Size == 7) {
    return sums.A;
  }
  else {
    Eigen::Matrix<double, 6, 6> A;
    A << sums.A.topLeftCorner<3, 3>(), sums.A.topRightCorner<3, 3>(),
        sums.A.bottomLeftCorner<3, 3>(), sums.A.bottomRightCorner<3, 3>();
    return A;
  }
}

template <int Size>
Eigen::Matrix<double, Size, 1>
vectorOf(const LinkSums& sums)
{
  if constexpr (Size == 7)
    return sums.b;
  else
    return (Eigen::Matrix<double, 6, 1>() << sums.b.head<3>(), sums.b.tail<3>())
        .finished();
}

/** \return the inverse of the left Jacobian of SE(3): e' = e + J^-1 D for the twist e' of
 * exp(D) exp(e), to first order in D */
Eigen::Matrix<double, 6, 6>
inverseJacobian(const Twist& e)
{
  Eigen::Matrix<double, 6, 6> ad = Eigen::Matrix<double, 6, 6>::Zero();
  ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = skew(e.tail<3>());
  ad.topRightCorner<3, 3>() = skew(e.head<3>());
  // J = sum ad^n / (n + 1)!; |x| <= pi, so the series converges quickly.
  constexpr int kTerms = 32;
  Eigen::Matrix<double, 6, 6> term = Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<double, 6, 6> J = term;
  for (int n = 1; n < kTerms; ++n) {
    term = (term * ad / (n + 1)).eval();
    J += term;
    if (term.squaredNorm() < 1e-36 * J.squaredNorm())
      break;
  }
  return inverted(J);
}

/** A six-dimensional equation, extended by a scale if needed. */
template <int Size>
LinkEquation<Size>
withScale(const LinkEquation<6>& rigid)
{
  if constexpr (Size == 6) {
    return rigid;
  }
  else {
    LinkEquation<7> equation;
    equation.centre = rigid.centre;
    equation.variance = rigid.variance;
    equation.K.topLeftCorner<3, 3>() = rigid.K.topLeftCorner<3, 3>();
    equation.K.topRightCorner<3, 3>() = rigid.K.topRightCorner<3, 3>();
    equation.K.bottomLeftCorner<3, 3>() = rigid.K.bottomLeftCorner<3, 3>();
    equation.K.bottomRightCorner<3, 3>() = rigid.K.bottomRightCorner<3, 3>();
    equation.K(3, 3) = kScaleHold * rigid.K.trace();
    equation.g << rigid.g.head<3>(), 0, rigid.g.tail<3>();
    equation.D << rigid.D.head<3>(), 0, rigid.D.tail<3>();
    return equation;
  }
}
} // namespace

template <int Size>
LinkEquation<Size>
equationOf(const LinkSums& sums, double least_variance)
{
  using Matrix = typename LinkEquation<Size>::Matrix;
  using Vector = typename LinkEquation<Size>::Vector;
  LinkEquation<Size> equation;
  equation.centre = sums.centre;
  equation.K = matrixOf<Size>(sums);
  equation.g = vectorOf<Size>(sums);
  const Whitening<Size> white = whiteningOf<Size>(sums);
  const Matrix resistance = white.inverse * equation.K * white.inverse;
  const auto eigen = symmetricEigen<Size>(resistance);
  const Matrix& V = eigen.vectors;
  Vector values = eigen.values, inverses = Vector::Zero();
  for (int i = 0; i < Size; ++i) {
    const bool open = !(values(i) >= kOpenDirection);
    equation.open_directions += open;
    inverses(i) = open ? 0 : 1 / values(i);
    values(i) = open ? 0 : values(i);
  }
  const Vector asked = V.transpose() * white.inverse * equation.g;
  equation.D = white.inverse * V * inverses.cwiseProduct(asked);
  if (equation.open_directions > 0) {
    const Matrix back = white.root * V;
    equation.K = back * values.asDiagonal() * back.transpose();
    equation.g = back * values.cwiseProduct(inverses.cwiseProduct(asked));
  }
  const double rest = sums.residual_sq - asked.dot(inverses.cwiseProduct(asked));
  equation.variance =
      std::max(rest / std::max(1.0, sums.equations - Size), least_variance);
  return equation;
}

template <int Size>
LinkEquation<Size>
equationOf(const PoseLink& link,
           const Eigen::Isometry3d& T_world_from,
           const Eigen::Isometry3d& T_world_to)
{
  // The error e, in the axes of the measured b, changes by J^-1 R^T (X_a - X_b).
  const Eigen::Isometry3d measured = T_world_from * link.T_from_to;
  const Twist e = twistFromMotion(measured.inverse() * T_world_to);
  Eigen::Matrix<double, 6, 6> axes = Eigen::Matrix<double, 6, 6>::Zero();
  axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() =
      measured.linear().transpose();
  const Eigen::Matrix<double, 6, 6> P = inverseJacobian(e) * axes;
  LinkEquation<6> equation;
  equation.centre = measured.translation();
  equation.K = P.transpose() * link.information * P;
  equation.g = -P.transpose() * link.information * e;
  equation.D = -axes.transpose() * e;
  equation.variance = 1;
  return withScale<Size>(equation);
}

template LinkEquation<6>
equationOf<6>(const LinkSums&, double);
template LinkEquation<7>
equationOf<7>(const LinkSums&, double);
template LinkEquation<6>
equationOf<6>(const PoseLink&, const Eigen::Isometry3d&, const Eigen::Isometry3d&);
template LinkEquation<7>
equationOf<7>(const PoseLink&, const Eigen::Isometry3d&, const Eigen::Isometry3d&);

} // namespace pcl6d::graph_relaxation
