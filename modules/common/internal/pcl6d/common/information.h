// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Largest difference of an entry of an information matrix from its mirror image,
 * relative to the largest entry: rounding. */
constexpr double kAsymmetryTolerance = 1e-9;

/** \brief Largest magnitude of a negative eigenvalue of an information matrix, relative to the
 * largest eigenvalue: digits lost in a text file. */
constexpr double kNegativeTolerance = 1e-6;

/** \return the fault of an information matrix (inverse covariance): "not finite", "not
 * symmetric", "not positive semidefinite"; empty: no fault within the tolerances above
 * \ingroup common */
std::string
informationFault(const Eigen::Matrix<double, 6, 6>& information);

/** \return the matrix made symmetric, with negative eigenvalues set to zero: no motion lowers a
 * sum of squares below zero. A valid matrix keeps all bits. \param[in] information without a
 * fault */
Eigen::Matrix<double, 6, 6>
semidefinite(const Eigen::Matrix<double, 6, 6>& information);

} // namespace pcl6d
