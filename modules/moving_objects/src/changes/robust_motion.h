// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visibility/sight_evidence.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief A point and its target plane, in the world. */
struct PlanePair {
  Eigen::Vector3d place;
  Eigen::Vector3d normal; ///< unit vector of the plane
  double residual;        ///< [m] along the normal, from the point to the plane
};

/** \brief The small motion that moves points onto their planes. */
struct RobustMotion {
  /** velocity of the centre, then rotation, in the axes of the world [m, rad] */
  Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
  MotionCovariance covariance = MotionCovariance::Zero(); ///< of the step
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();       ///< [m]
  double scale = 0; ///< [m] standard deviation of residuals, by their median
  std::size_t pairs = 0;

  /** \return the step as a motion of points in the world */
  Eigen::Isometry3d
  motion() const;
  /** \return its covariance, plus the square of the remaining step, as a motion about a given
   * point in the world axes */
  MotionCovariance
  uncertaintyAbout(const Eigen::Vector3d& place) const;
};

/** \brief Point to plane with weights of Geman and McClure: changes do not bias the fit. The
 * covariance counts the pairs in a cube as one, as their errors are correlated. Motions left
 * open by the planes get no step, and the spread of the points as uncertainty.
 * \param[in] cube [m] > 0
 * \return pairs 0: fewer than 12
 * \note Source: share/doc/trust.md, Covariance (H^-1 (sum g_k g_k^T) H^-1 over cubes) */
RobustMotion
robustMotion(const std::vector<PlanePair>& pairs, double cube);

} // namespace pcl6d::moving_objects
