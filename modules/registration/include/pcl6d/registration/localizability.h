// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/plane_sums.h>

namespace pcl6d {

/** \brief Which motions the surfaces fix, and how well: the eigenvectors of the
 * point-to-plane normal equations of the pairs, whatever metric was minimised.
 *
 * Turns are scaled to the length that they move the points (rms), so that directions
 * and turns compare. An eigenvalue is the mean square of the share of a motion that is
 * along the normals: 1 when every surface stands across the motion, 1/3 in a cube for
 * each translation, 0 along an ideal corridor. The eigenvalues sum to at most 2.
 * \note Source: J. Zhang, M. Kaess, S. Singh, "On degeneracy of optimization-based state
 * estimation problems", ICRA 2016; scaling after N. Gelfand et al., "Geometrically
 * stable sampling for the ICP algorithm", 3DIM 2003. */
struct Localizability {
  Twist eigenvalues = Twist::Zero(); ///< ascending, in [0, 1]
  /** columns: unit twists about centroid; the turn in units of scale */
  PlaneSums::Matrix directions = PlaneSums::Matrix::Identity();
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero(); ///< [m] in the target's frame
  double scale = 1; ///< [m] rms distance of the points from the centroid

  /** \return the number of directions with an eigenvalue below a threshold: motions along
   * which the pose is not to be trusted */
  int
  openDirections(double threshold = kOpen) const;

  /** Normals of a noise-free corridor have errors of a few degrees: sin^2(2 deg). */
  static constexpr double kOpen = 1e-3;
};

/** \param[in] sums of pairs with their normals, at the pose */
Localizability
localizabilityOf(const PlaneSums& sums);

} // namespace pcl6d
