// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "manhattan_frames.h"

#include <pcl6d/scene_interpretation/model_refinement.h>

/** \file Planes from sums of their points. Internal to the module
 * scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \return centroid and scatter of a segment's points, with the segment's normal */
FittedPlane
fitted(const PlaneSegment& segment, const Points& points);

/** \brief Computes the least-squares normal and its covariance: noise of the points,
 * and errors of poses for a plane of this size.
 * \return false: the points lie on no plane */
bool
fitNormal(const RefinementOptions& options, FittedPlane& fit);

/** \brief A turn of a normal. */
struct Turn {
  double angle = 0;       ///< [rad]
  double uncertainty = 0; ///< [rad] standard deviation of the normal along the turn
};

Turn
turnTo(const FittedPlane& plane, const Eigen::Vector3d& exact);

} // namespace pcl6d::scene_interpretation
