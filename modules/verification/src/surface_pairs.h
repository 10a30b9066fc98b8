// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/surface_fit.h>

#include <cstddef>
#include <vector>

/** \file The two halves of fitSurfaces(): pairs are searched for once, and may be asked for
 * the step alone or for its covariance, too. */
namespace pcl6d::verification {

/** \brief A pair across a surface, in the frame of the first scan. */
struct SurfacePair {
  Eigen::Vector3d place;  ///< [m] of the second scan's point
  Eigen::Vector3d normal; ///< unit
  double residual;        ///< [m] what is missing along the normal
};

/** \brief What pairSurfaces() found. */
struct SurfacePairs {
  std::vector<SurfacePair> pairs;
  std::size_t looked_at = 0; ///< points, of both scans
  double voxel = 0;          ///< [m] the larger one of both scans
};

/** \param[in] T_first_second pose of the second scan seen from the first
 * \throws BadArgument an option breaks its rule */
SurfacePairs
pairSurfaces(const VerifiedScan& first,
             const VerifiedScan& second,
             const Eigen::Isometry3d& T_first_second,
             const SurfaceFitOptions& options);

/** \return no pairs: everything 0 */
SurfaceFit
fitOf(const SurfacePairs& found, const SurfaceFitOptions& options);

} // namespace pcl6d::verification
