// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/plane_sums.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How well surfaces fix each direction of motion, for any minimised metric.
 *
 * A small motion v moves a point of a surface with normal n by |v|, and towards the surface by
 * n^T v. An eigenvalue is the mean square of n^T v over the mean square of |v|: 1 when every
 * surface is perpendicular to the motion, 1/3 in a cube for a translation, 0 along an ideal
 * corridor. The eigenvalues depend neither on units nor on the extent of the scene. They solve
 * A u = e B u, where A is the matrix of the point-to-plane normal equations and B its counterpart
 * for distances of points.
 * \note Source: J. Zhang, M. Kaess, S. Singh, "On degeneracy of optimization-based state estimation
 * problems", ICRA 2016; here free of units. */
struct Localizability {
  Twist eigenvalues = Twist::Zero(); ///< ascending, in [0, 1]
  /** columns: twists about the centroid; each moves the points by 1 m (rms) */
  PlaneSums::Matrix directions = PlaneSums::Matrix::Identity();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero(); ///< [m] in the target's frame

  /** \return the number of directions with an eigenvalue below a threshold: motions along which the
   * pose is unreliable */
  int
  openDirections(double threshold = kOpen) const;

  /** Estimated normals err by a few degrees and feign a constraint: sin^2(6 deg). Matches of
   * recorded corridors have 0.03 and more. */
  static constexpr double kOpen = 0.01;
};

/** \param[in] sums of pairs with their normals, at the pose */
Localizability
localizabilityOf(const PlaneSums& sums);

} // namespace pcl6d
