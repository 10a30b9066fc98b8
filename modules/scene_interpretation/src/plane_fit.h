// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "manhattan_frames.h"

#include <pcl6d/scene_interpretation/model_refinement.h>

/** \file Planes as the sums of their points know them. Internal to the module
 * scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \return centroid and scatter of a segment's points; its normal as it is */
FittedPlane
fitted(const PlaneSegment& segment, const Points& points);

/** \brief The least-squares normal and its covariance: the noise of the points, and
 * what the errors of poses do to a plane of this size.
 * \return false: the points lie on no plane */
bool
fitNormal(const RefinementOptions& options, FittedPlane& fit);

/** \brief A turn of a normal. */
struct Turn {
  double angle = 0;       ///< [rad]
  double uncertainty = 0; ///< [rad] standard deviation of the normal along it
};

Turn
turnTo(const FittedPlane& plane, const Eigen::Vector3d& exact);

} // namespace pcl6d::scene_interpretation
