// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

/** \file
 * Fits and eigenvalues by Eigen, independent of the suite's own. Compiled once
 * (fit_oracles.cpp): each decomposition costs seconds in each file that calls it. */
namespace pcl6d::test {

/** \return the transform of the points d into m (columns) by Umeyama's closed form (1991) */
Eigen::Matrix4d
umeyama(const Eigen::Matrix3Xd& d, const Eigen::Matrix3Xd& m, bool with_scale);

/** \return x that minimises |J x - r|, by QR with pivots */
Eigen::VectorXd
leastSquares(const Eigen::MatrixXd& J, const Eigen::VectorXd& r);

/** \return the smallest eigenvalue of a symmetric matrix */
double
smallestEigenvalue(const Eigen::MatrixXd& A);

} // namespace pcl6d::test
