// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of fitSurfaces(). */
struct SurfaceFitOptions {
  double max_distance = 0.25; ///< [m] farther pairs are dropped; finite, > 0
  std::size_t points = 1500;  ///< paired points of a scan; > 0
  /** [voxels] edge of the cubes whose points count as a single observation; finite, > 0 */
  double cube_voxels = 16;
  /** share of the residuals that is an error common to all pairs: points are denser near the
   * scanner, which pulls scans together along oblique surfaces; >= 0. Fitted to the poses of
   * eleven simulated scenes, to keep the roughest within its bounds: in a mine, scans come 1 % too
   * near. */
  double shared_error = 0.6;
  bool covariance = true; ///< false: left zero, to save time
  /** \throws BadArgument naming the first invalid field, with its value */
  void
  validate() const;
};

/** \brief The fit of two scans' surfaces at a pose, and the motion to their best fit.
 *
 * Motions are twists of the second scan about the centroid of the pairs, in the frame of the
 * first. */
struct SurfaceFit {
  std::size_t pairs = 0;
  double overlap = 0;  ///< share of tested points with a partner, in both directions
  double residual = 0; ///< [m] rms distance across the surfaces
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero(); ///< [m] of the pairs
  double spread = 0;          ///< [m] rms distance of the pairs from the centroid
  Twist step = Twist::Zero(); ///< best motion by one Gauss-Newton step
  /** of the pose, for the test of a single link: points of a cube count as one, because their
   * errors are correlated, and the error common to all pairs is added; unconstrained directions
   * have the spread of the pairs as deviation */
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /** of the pose, as a measurement among many links: errors of the normals of one scan cancel,
   * because both scans' normals count, and points of a whole surface count as one if this gives
   * larger errors than cubes */
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  int open_directions = 0; ///< motions unconstrained by the surfaces

  /** \return [m] rms motion of the pairs by the step */
  double
  displacement() const;
  /** \return [m] standard deviation of the pairs' position, rms over the directions of the largest
   * deviation */
  double
  deviation() const;
  /** \return the squared Mahalanobis length of the step, over its 6 directions */
  double
  mahalanobisSq() const;
};

/** \brief Pairs the nearest points of two scans at a pose, and computes one point-to-plane step
 * with both directions.
 * \param[in] T_first_second pose of the second scan seen from the first
 * \return no pairs: everything 0
 * \throws BadArgument an option is invalid
 * \note Source: share/doc/trust.md, Surfaces (covariance H^-1 (sum g_k g_k^T) H^-1 over cubes,
 * averaged over shifted grids, with P / (P - 6) for P cubes). */
SurfaceFit
fitSurfaces(const VerifiedScan& first,
            const VerifiedScan& second,
            const Eigen::Isometry3d& T_first_second,
            const SurfaceFitOptions& options);

} // namespace pcl6d
