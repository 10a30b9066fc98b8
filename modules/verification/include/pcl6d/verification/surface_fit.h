// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/verification/verified_scan.h>

#include <Eigen/Geometry>

#include <cstddef>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of fitSurfaces(). */
struct SurfaceFitOptions {
  double max_distance = 0.25; ///< [m] farther pairs are dropped; finite, > 0
  std::size_t points = 1500;  ///< so many of a scan are paired; > 0
  double cube_voxels =
      16; ///< points in cubes of so many voxels count as one; finite, > 0
  /** of residuals, as all pairs share it: points lie denser where a scan stands, which pulls
   * scans together along what is oblique; >= 0. Fitted to the poses of eleven simulated
   * scenes so that the roughest stays within its bounds: in a mine scans come 1 % too near. */
  double shared_error = 0.6;
  bool covariance = true; ///< false leaves it zero, which takes less time
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief How the surfaces of two scans fit at a pose, and where they would like to be.
 *
 * Motions are twists of the second scan about the centroid of the pairs, in the frame of
 * the first. */
struct SurfaceFit {
  std::size_t pairs = 0;
  double overlap = 0;  ///< share of the points looked at that have a partner, both ways
  double residual = 0; ///< [m] rms distance across the surfaces
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero(); ///< [m] of the pairs
  double spread = 0;          ///< [m] rms distance of the pairs from it
  Twist step = Twist::Zero(); ///< the motion that fits best, by one Gauss-Newton step
  /** of the pose: points of a cube count as one, as their errors hang together, and an error
   * that all pairs share is added; directions that the surfaces leave open are as uncertain
   * as the pairs are spread */
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /** the part of the covariance that stems from an error which all pairs share */
  Eigen::Matrix<double, 6, 6> shared = Eigen::Matrix<double, 6, 6>::Zero();
  int open_directions = 0; ///< motions that the surfaces do not fix

  /** \return [m] rms motion of the pairs by the step */
  double
  displacement() const;
  /** \return [m] standard deviation of the place of the pairs, rms over the directions in
   * which it is largest */
  double
  deviation() const;
  /** \return the squared step in standard deviations, over its 6 directions */
  double
  mahalanobisSq() const;
};

/** \brief Pairs the points of two scans at a pose, nearest first, and takes one step of
 * point to plane, both ways.
 * \param[in] T_first_second pose of the second scan seen from the first
 * \return no pairs: everything 0
 * \throws BadArgument an option breaks its rule
 * \note Source: algorithms.md T.3 (cluster covariance: H^-1 (sum g_k g_k^T) H^-1 over
 * cubes, averaged over shifted grids, with P / (P - 6) for P cubes). */
SurfaceFit
fitSurfaces(const VerifiedScan& first,
            const VerifiedScan& second,
            const Eigen::Isometry3d& T_first_second,
            const SurfaceFitOptions& options);

} // namespace pcl6d
