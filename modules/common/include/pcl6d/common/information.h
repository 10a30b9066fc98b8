// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief So far an entry of an information matrix may be from its mirror image, beside
 * the largest entry: rounding. */
constexpr double kAsymmetryTolerance = 1e-9;

/** \brief So far below zero an eigenvalue of an information matrix may be, beside the
 * largest one: digits that a text file has lost. */
constexpr double kNegativeTolerance = 1e-6;

/** \return what an information matrix (inverse covariance) breaks: "not finite", "not
 * symmetric", "not positive semidefinite"; empty: nothing, within the tolerances above
 * \ingroup common */
std::string
informationFault(const Eigen::Matrix<double, 6, 6>& information);

/** \return the matrix without what the tolerances let pass: symmetric, negative
 * eigenvalues zero, so that no motion lowers a sum of squares below zero; the same bits
 * if there is nothing to repair. \param[in] information one without a fault */
Eigen::Matrix<double, 6, 6>
semidefinite(const Eigen::Matrix<double, 6, 6>& information);

} // namespace pcl6d
