// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace pcl6d {

namespace {
/** Ratio of singular values below which a direction counts as not fixed. */
constexpr double kRankTolerance = 1e-9;

/** The smallest rotation that takes unit vector a to unit vector b. */
Eigen::Matrix3d
minimalRotation(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return Eigen::Quaterniond::FromTwoVectors(a, b).toRotationMatrix();
}

/** The motion by a rotation that also takes the centroid to its partner. */
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
} // namespace

Eigen::Matrix3d
rotationByQuaternion(const Eigen::Matrix3d& S)
{
  // N is built from the trace, the antisymmetric and the symmetric part of S.
  const Eigen::Vector3d turn(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  Eigen::Matrix4d N;
  N(0, 0) = S.trace();
  N.topRightCorner<1, 3>() = turn.transpose();
  N.bottomLeftCorner<3, 1>() = turn;
  N.bottomRightCorner<3, 3>() =
      S + S.transpose() - S.trace() * Eigen::Matrix3d::Identity();
  // The maximising quaternion is the eigenvector of the largest eigenvalue (the last).
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(N);
  const Eigen::Vector4d q = solver.eigenvectors().col(3); // order w, x, y, z
  return Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
}

RigidEstimate
minimiseRigid(const PairSums& sums, Eigen::Matrix3d (*rotation)(const Eigen::Matrix3d&))
{
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  if (sums.count == 0)
    return {Status::kTooFewPairs, Eigen::Isometry3d::Identity()};
  if (!sums.cross.allFinite() || !sums.mean_source.allFinite() ||
      !sums.mean_target.allFinite())
    return {Status::kDiverged, Eigen::Isometry3d::Identity()};
  const double nothing = 1e-18 * sums.weight; // (1 nm)^2 per pair
  if (sums.count == 1 || sums.sourceSq() <= nothing || sums.target_sq <= nothing)
    return rankDeficient(sums, identity);

  // S = U diag(s) V^T; source directions are the columns of U, target directions of V.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      sums.cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d s = svd.singularValues();
  const double limit = kRankTolerance * s(0);
  if (sums.count == 2 || s(1) <= limit)
    return rankDeficient(sums,
                         minimalRotation(svd.matrixU().col(0), svd.matrixV().col(0)));
  const bool mirrored = sums.cross.determinant() < 0;
  const Eigen::Isometry3d T = aboutCentroids(sums, rotation(sums.cross));
  if (mirrored && s(1) - s(2) <= limit)
    return {Status::kRankDeficient, T};
  return {Status::kOk, T};
}

RigidEstimate
minimiseByQuaternion(const PairSums& sums)
{
  return minimiseRigid(sums, &rotationByQuaternion);
}

} // namespace pcl6d
