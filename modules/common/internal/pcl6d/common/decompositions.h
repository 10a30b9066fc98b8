// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

/** \file Eigen's decompositions in the sizes used by the suite, compiled once: each
 * instantiation costs seconds of compile time, the extra function call is negligible. */
namespace PCL6D_EXPORTS pcl6d {

/** A = V diag(values) V^T. */
template <int Size>
struct SymmetricEigen {
  Eigen::Matrix<double, Size, 1> values;     ///< ascending
  Eigen::Matrix<double, Size, Size> vectors; ///< V: unit eigenvectors as columns
};

/** \param[in] A symmetric: only the lower triangle is read. Size: 2, 3, 4, 6, 7 or
 * Eigen::Dynamic
 * \ingroup common */
template <int Size>
SymmetricEigen<Size>
symmetricEigen(const Eigen::Matrix<double, Size, Size>& A);

/** \return the eigenvalues alone, ascending; Size: 3 or 6 */
template <int Size>
Eigen::Matrix<double, Size, 1>
symmetricEigenvalues(const Eigen::Matrix<double, Size, Size>& A);

/** \return x of A x = b by LDL^T; A is symmetric and semidefinite; Size: 3 or 6 */
template <int Size>
Eigen::Matrix<double, Size, 1>
solveSymmetric(const Eigen::Matrix<double, Size, Size>& A,
               const Eigen::Matrix<double, Size, 1>& b);

/** \return whether Cholesky's method finds the symmetric A positive definite; Size: 3 or
 * 6 */
template <int Size>
bool
isPositiveDefinite(const Eigen::Matrix<double, Size, Size>& A);

/** \return the inverse of an invertible matrix; Size: 6 */
template <int Size>
Eigen::Matrix<double, Size, Size>
inverted(const Eigen::Matrix<double, Size, Size>& A);

/** A = U diag(values) V^T. */
struct SingularValues {
  Eigen::Matrix3d U;
  Eigen::Vector3d values; ///< descending
  Eigen::Matrix3d V;
};

/** Jacobi's method. */
SingularValues
singularValues(const Eigen::Matrix3d& A);

} // namespace pcl6d
