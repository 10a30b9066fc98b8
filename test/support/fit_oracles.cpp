// SPDX-License-Identifier: BSD-3-Clause
#include "support/fit_oracles.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

namespace pcl6d::test {

Eigen::Matrix4d
umeyama(const Eigen::Matrix3Xd& d, const Eigen::Matrix3Xd& m, bool with_scale)
{
  return Eigen::umeyama(d, m, with_scale);
}

Eigen::VectorXd
leastSquares(const Eigen::MatrixXd& J, const Eigen::VectorXd& r)
{
  return J.colPivHouseholderQr().solve(r);
}

double
smallestEigenvalue(const Eigen::MatrixXd& A)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly)
      .eigenvalues()(0);
}

} // namespace pcl6d::test
