// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/information.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pcl6d {

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** Scaled to a largest entry of one, as squares of huge entries overflow. */
Matrix6
scaled(const Matrix6& information)
{
  const double largest = information.cwiseAbs().maxCoeff();
  return largest > 0 ? Matrix6(information / largest) : information;
}

bool
isPositiveDefinite(const Matrix6& information)
{
  return information.llt().info() == Eigen::Success;
}
} // namespace

std::string
informationFault(const Matrix6& information)
{
  if (!information.allFinite())
    return "not finite";
  const Matrix6 I = scaled(information);
  if ((I - I.transpose()).cwiseAbs().maxCoeff() > kAsymmetryTolerance)
    return "not symmetric";
  if (isPositiveDefinite(I))
    return "";
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(I, Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues(); // ascending
  return values(0) >= -kNegativeTolerance * values(5) ? ""
                                                      : "not positive semidefinite";
}

Matrix6
semidefinite(const Matrix6& information)
{
  const bool symmetric = information == information.transpose();
  const Matrix6 I =
      symmetric ? information : 0.5 * (information + information.transpose());
  if (I.isZero(0) || isPositiveDefinite(I))
    return I;
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(I);
  if (solver.eigenvalues()(0) >= 0)
    return I;
  const Matrix6& V = solver.eigenvectors();
  const Matrix6 projected =
      V * solver.eigenvalues().cwiseMax(0).asDiagonal() * V.transpose();
  return 0.5 * (projected + projected.transpose());
}

} // namespace pcl6d
