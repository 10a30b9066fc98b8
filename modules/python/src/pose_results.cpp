// SPDX-License-Identifier: BSD-3-Clause
#include "pose_results.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/registration/twist.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl6d::python {

Eigen::Isometry3d
poseOfPair(const Eigen::Isometry3d& T_target_source,
           const Cloud& target,
           const Cloud& source)
{
  return Eigen::Translation3d(target.offset) * source.poseOfRows(T_target_source);
}

Eigen::Isometry3d
guessOfPair(const Eigen::Isometry3d& T_target_source,
            const Cloud& target,
            const Cloud& source)
{
  return Eigen::Translation3d(-target.offset) * source.poseOfPoints(T_target_source);
}

/** The position of the rows is t - R o: a turn by the world's angular velocity w moves R o by
 * w x R o. */
Matrix6d
movedCovariance(const Matrix6d& covariance,
                const Eigen::Isometry3d& T_target_source,
                const Eigen::Vector3d& offset)
{
  const Eigen::Matrix3d rates = eulerRates(eulerFromRotation(T_target_source.linear()));
  Matrix6d jacobian = Matrix6d::Identity();
  jacobian.topRightCorner<3, 3>() = skew(T_target_source.linear() * offset) * rates;
  return jacobian * covariance * jacobian.transpose();
}

Matrix6d
eulerCovariance(const Matrix6d& covariance, const Eigen::Isometry3d& T_target_source)
{
  const Eigen::Matrix3d R = T_target_source.linear();
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = R;
  jacobian.bottomRightCorner<3, 3>() = eulerRates(eulerFromRotation(R)).inverse() * R;
  return jacobian * covariance * jacobian.transpose();
}

py::object
matrixOrNone(const std::optional<Matrix6d>& matrix)
{
  if (!matrix)
    return py::none();
  return arrayOf(Eigen::MatrixXd(*matrix));
}

py::array_t<double>
freeDirections(const Localizability& localizability)
{
  const Eigen::MatrixXd columns =
      localizability.directions.leftCols(localizability.openDirections());
  return arrayOf(Eigen::MatrixXd(columns.transpose()));
}

/** An open direction has the largest covariance. */
py::array_t<double>
freeDirections(const SurfaceFit& fit)
{
  Twist scale = Twist::Ones(); // rotations are scaled to displacements at the spread
  scale.tail<3>().setConstant(std::max(fit.spread, 1e-9));
  const Matrix6d scaled = scale.asDiagonal() * fit.covariance * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(scaled);
  Eigen::MatrixXd rows(fit.open_directions, 6);
  for (int k = 0; k < fit.open_directions; ++k)
    rows.row(k) = solver.eigenvectors().col(5 - k).cwiseQuotient(scale).transpose();
  return arrayOf(rows);
}

} // namespace pcl6d::python
