// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/information.h>

namespace pcl6d {

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** Scaled to a largest entry of one, because squares of huge entries overflow. */
Matrix6
scaled(const Matrix6& information)
{
  const double largest = information.cwiseAbs().maxCoeff();
  return largest > 0 ? Matrix6(information / largest) : information;
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
  const auto values = symmetricEigenvalues(I); // ascending
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
  const auto eigen = symmetricEigen<6>(I);
  if (eigen.values(0) >= 0)
    return I;
  const Matrix6& V = eigen.vectors;
  const Matrix6 projected = V * eigen.values.cwiseMax(0).asDiagonal() * V.transpose();
  return 0.5 * (projected + projected.transpose());
}

} // namespace pcl6d
