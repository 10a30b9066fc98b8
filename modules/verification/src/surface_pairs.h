// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/surface_fit.h>

#include <cstddef>
#include <vector>

/** \file The two halves of fitSurfaces(): pairs are searched for once, then used for the step alone
 * or also for its covariance. */
namespace pcl6d::verification {

/** \brief A pair across a surface, in the frame of the first scan. */
struct SurfacePair {
  Eigen::Vector3d place;  ///< [m] of the second scan's point
  Eigen::Vector3d normal; ///< unit; along it the distance is measured
  /** unit, of the other point, from the points of the other scan: its error is independent of the
   * error of `normal` */
  Eigen::Vector3d other_normal;
  double residual;       ///< [m] distance to the partner along the normal
  double other_residual; ///< [m] the same along `other_normal`
  double copies = 1;     ///< number of equal pairs that stand for one
  double weight = 1;     ///< of the squared distance
};

/** \brief The result of pairSurfaces(). */
struct SurfacePairs {
  /** first those of an even selection of the points, then, where these leave a motion open, those
   * of all surfaces that face the motion */
  std::vector<SurfacePair> pairs;
  std::size_t evenly = 0;    ///< number of the pairs of the even selection
  std::size_t looked_at = 0; ///< points of the even selection, of both scans
  double voxel = 0;          ///< [m] of the coarser scan
};

/** \param[in] T_first_second pose of the second scan seen from the first
 * \throws BadArgument an option is invalid */
SurfacePairs
pairSurfaces(const VerifiedScan& first,
             const VerifiedScan& second,
             const Eigen::Isometry3d& T_first_second,
             const SurfaceFitOptions& options);

/** \return no pairs: everything 0 */
SurfaceFit
fitOf(const SurfacePairs& found, const SurfaceFitOptions& options);

} // namespace pcl6d::verification
