// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.h"

#include <pcl6d/registration/localizability.h>
#include <pcl6d/verification/surface_fit.h>

#include <Eigen/Geometry>

#include <optional>

/** \file Poses of pairs with their covariances, carried from centred points to the user's. */
namespace pcl6d::python {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** \return T_target_source of the user's rows */
Eigen::Isometry3d
poseOfPair(const Eigen::Isometry3d& T_target_source,
           const Cloud& target,
           const Cloud& source);
/** \return the guess for the points, from the guess for the rows */
Eigen::Isometry3d
guessOfPair(const Eigen::Isometry3d& T_target_source,
            const Cloud& target,
            const Cloud& source);

/** \return the covariance (x y z roll pitch yaw) of a pose after moving the origin of the source
 * \param[in] T_target_source of the points before the move
 * \param[in] offset [m] of the source's points */
Matrix6d
movedCovariance(const Matrix6d& covariance,
                const Eigen::Isometry3d& T_target_source,
                const Eigen::Vector3d& offset);

/** \return the covariance (x y z roll pitch yaw) of a pose from the covariance of a small motion
 * about the source's origin, in the source's axes */
Matrix6d
eulerCovariance(const Matrix6d& covariance, const Eigen::Isometry3d& T_target_source);

/** \return a 6x6 array, or None */
py::object
matrixOrNone(const std::optional<Matrix6d>& matrix);

/** \return (k, 6) motions not fixed by the surfaces, about the centroid of the pairs in the
 * target's axes, each scaled to move the pairs by 1 m (rms) */
py::array_t<double>
freeDirections(const Localizability& localizability);
py::array_t<double>
freeDirections(const SurfaceFit& fit);

} // namespace pcl6d::python
