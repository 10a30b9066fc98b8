// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <algorithm>
#include <cmath>

/** \file
 * The closed forms are constrained extrema (book, Appendix A.5), stationary points of
 * f - lambda . c:
 * - quaternion: q^T N q with |q| = 1, hence N q = lambda q, the largest eigenvalue;
 * - dual quaternion: real part r and dual part s with |r| = 1 and r . s = 0; the second
 *   condition gives s in terms of r, the first an eigenvector;
 * - svd: trace(R S) with R^T R = I; the multipliers form a symmetric matrix L with
 *   S^T = L R: the singular vectors; det R = 1 by the sign of the smallest;
 * - orthonormal: like svd, with L by the square root of S^T S. An eigenvalue that is
 * not simple means a family of minimisers: kRankDeficient. */
namespace pcl6d {

namespace {
/** Ratio of singular values below which a direction is not fixed. */
constexpr double kFreeDirection = 1e-9;

/** The smallest rotation that takes unit vector a to unit vector b. */
Eigen::Matrix3d
minimalRotation(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return shortestRotation(a, b).toRotationMatrix();
}

/** The motion by a rotation, with the translation that takes the source centroid to the
 * target centroid. */
Eigen::Isometry3d
aboutCentroids(const PairSums& sums, const Eigen::Matrix3d& R)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R;
  T.translation() = sums.mean_target - R * sums.mean_source;
  return T;
}

RigidEstimate
rankDeficient(const PairSums& sums, const Eigen::Matrix3d& R)
{
  return {Status::kRankDeficient, aboutCentroids(sums, R)};
}

/** Mirrored pairs with the last `count` singular values equal: R = V (I - 2 n n^T) U^T
 * is equally good for every unit n in their span. The smallest rotation has the
 * largest trace, hence the n of least n^T U^T V n. */
Eigen::Matrix3d
smallestOfMirrored(const Eigen::Matrix3d& U, const Eigen::Matrix3d& V, int count)
{
  const Eigen::MatrixXd M = (U.transpose() * V).bottomRightCorner(count, count);
  const auto eigen = symmetricEigen<Eigen::Dynamic>(M + M.transpose());
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  n.tail(count) = eigen.vectors.col(0);
  return V * (Eigen::Matrix3d::Identity() - 2 * n * n.transpose()) * U.transpose();
}

/** Horn's N: trace, antisymmetric and symmetric part of S. */
Eigen::Matrix4d
hornMatrix(const Eigen::Matrix3d& S)
{
  const Eigen::Vector3d turn(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  Eigen::Matrix4d N;
  N(0, 0) = S.trace();
  N.topRightCorner<1, 3>() = turn.transpose();
  N.bottomLeftCorner<3, 1>() = turn;
  N.bottomRightCorner<3, 3>() =
      S + S.transpose() - S.trace() * Eigen::Matrix3d::Identity();
  return N;
}

/** \param[in] q in the order w, x, y, z */
Eigen::Quaterniond
quaternion(const Eigen::Vector4d& q)
{
  return {q(0), q(1), q(2), q(3)};
}

/** The grid point nearest to a centroid; spacing: a power of two not above spread. */
Eigen::Vector3d
roundedTo(const Eigen::Vector3d& centroid, double spread)
{
  int exponent = 0;
  std::frexp(spread, &exponent);
  const double grid = std::ldexp(1.0, exponent - 1);
  return (centroid / grid).array().round() * grid;
}

/** Q(m) - W(d) of pure quaternions: left minus right multiplication. */
Eigen::Matrix4d
commutator(const Eigen::Vector3d& m, const Eigen::Vector3d& d)
{
  Eigen::Matrix4d C = Eigen::Matrix4d::Zero();
  C.topRightCorner<1, 3>() = (d - m).transpose();
  C.bottomLeftCorner<3, 1>() = m - d;
  C.bottomRightCorner<3, 3>() = skew(m + d);
  return C;
}
} // namespace

Eigen::Matrix3d
rotationByQuaternion(const Eigen::Matrix3d& S)
{
  // The maximising quaternion is the eigenvector of the largest eigenvalue (the last).
  const auto eigen = symmetricEigen<4>(hornMatrix(S));
  return quaternion(eigen.vectors.col(3)).normalized().toRotationMatrix();
}

Eigen::Matrix3d
rotationBySVD(const Eigen::Matrix3d& S)
{
  return nearestRotation(S.transpose());
}

Eigen::Matrix3d
rotationByOrthonormal(const Eigen::Matrix3d& S)
{
  const Eigen::Matrix3d M = S.transpose();
  const Eigen::Vector3d u1 = symmetricEigen<3>(M.transpose() * M).vectors.col(2);
  const Eigen::Vector3d v1 = (M * u1).normalized();
  // M^T M holds ratios of singular values down to 1e-8 only; without its first
  // direction the matrix shows the second to full accuracy.
  const Eigen::Matrix3d rest = M - v1 * (v1.transpose() * M);
  Eigen::Vector3d u2 = symmetricEigen<3>(rest.transpose() * rest).vectors.col(2);
  u2 = (u2 - u1 * u1.dot(u2)).normalized();
  Eigen::Vector3d v2 = rest * u2;
  v2 = (v2 - v1 * v1.dot(v2)).normalized();
  return v1 * u1.transpose() + v2 * u2.transpose() +
         v1.cross(v2) * u1.cross(u2).transpose();
}

std::optional<RigidEstimate>
degenerateEstimate(const PairSums& sums)
{
  if (sums.count == 0)
    return RigidEstimate{Status::kTooFewPairs, Eigen::Isometry3d::Identity()};
  if (!sums.cross.allFinite() || !sums.scatter.allFinite() ||
      !sums.mean_source.allFinite() || !sums.mean_target.allFinite() ||
      !std::isfinite(sums.target_sq))
    return RigidEstimate{Status::kDiverged, Eigen::Isometry3d::Identity()};
  const double nothing = 1e-18 * sums.weight; // (1 nm)^2 per pair
  if (sums.count == 1 || sums.sourceSq() <= nothing || sums.target_sq <= nothing)
    return rankDeficient(sums, Eigen::Matrix3d::Identity());

  // S = U diag(s) V^T; source directions are the columns of U, target directions of V.
  const auto [U, s, V] = singularValues(sums.cross);
  const double limit = kFreeDirection * s(0);
  if (sums.count == 2 || s(1) <= limit)
    return rankDeficient(sums, minimalRotation(U.col(0), V.col(0)));
  const bool mirrored = U.determinant() * V.determinant() < 0;
  if (mirrored && s(2) > limit && s(1) - s(2) <= limit)
    return rankDeficient(sums, smallestOfMirrored(U, V, s(0) - s(2) <= limit ? 3 : 2));
  return std::nullopt;
}

RigidEstimate
minimiseRigid(const PairSums& sums, Eigen::Matrix3d (*rotation)(const Eigen::Matrix3d&))
{
  if (const auto degenerate = degenerateEstimate(sums))
    return *degenerate;
  return {Status::kOk, aboutCentroids(sums, rotation(sums.cross))};
}

RigidEstimate
minimiseByQuaternion(const PairSums& sums)
{
  return minimiseRigid(sums, &rotationByQuaternion);
}

RigidEstimate
minimiseBySVD(const PairSums& sums)
{
  return minimiseRigid(sums, &rotationBySVD);
}

RigidEstimate
minimiseByOrthonormal(const PairSums& sums)
{
  return minimiseRigid(sums, &rotationByOrthonormal);
}

RigidEstimate
minimiseByDualQuaternion(const PairSums& sums)
{
  if (const auto degenerate = degenerateEstimate(sums))
    return *degenerate;
  const double spread = std::sqrt(std::min(sums.sourceSq(), sums.target_sq) / //
                                  sums.weight);
  const Eigen::Vector3d offset_d = roundedTo(sums.mean_source, spread);
  const Eigen::Vector3d offset_m = roundedTo(sums.mean_target, spread);
  const Eigen::Vector3d d = sums.mean_source - offset_d;
  const Eigen::Vector3d m = sums.mean_target - offset_m;
  const double W = sums.weight;

  // The book's C1 = -2 sum w Q(m)^T W(d) is -2 N of the sums about the offsets.
  const Eigen::Matrix4d C1 = -2 * hornMatrix(sums.cross + W * d * m.transpose());
  const Eigen::Matrix4d C3 = W * commutator(m, d);
  const Eigen::Matrix4d A = C1 - C3.transpose() * C3 / W;
  const auto eigen = symmetricEigen<4>(A);
  const Eigen::Vector4d real = eigen.vectors.col(0).normalized();
  const Eigen::Vector4d dual = C3 * real / W; // twice the dual part

  const Eigen::Quaterniond q = quaternion(real);
  RigidEstimate estimate{Status::kOk, Eigen::Isometry3d::Identity()};
  estimate.transform.linear() = q.toRotationMatrix();
  estimate.transform.translation() = (quaternion(dual) * q.conjugate()).vec() +
                                     offset_m - estimate.transform.linear() * offset_d;
  return estimate;
}

SimilarityEstimate
similarityByQuaternion(const PairSums& sums)
{
  SimilarityEstimate estimate;
  estimate.rigid = minimiseByQuaternion(sums);
  estimate.transform = estimate.rigid.transform;
  if (estimate.rigid.status != Status::kOk)
    return estimate;
  const Eigen::Matrix3d R = estimate.rigid.transform.linear();
  const double scale = (R * sums.cross).trace() / sums.sourceSq();
  if (!(scale > 0))
    return estimate;
  estimate.scale = scale;
  estimate.transform.linear() = scale * R;
  estimate.transform.translation() =
      sums.mean_target - estimate.transform.linear() * sums.mean_source;
  return estimate;
}

RigidEstimate
minimiseByScaleQuaternion(const PairSums& sums)
{
  return similarityByQuaternion(sums).rigid;
}

} // namespace pcl6d
