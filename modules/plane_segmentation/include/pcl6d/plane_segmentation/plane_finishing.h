// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What makes a plane; shared by all detectors. Distances in standard deviations
 * count the sensor's noise at the place of the point (PlaneCloud::noise()). */
struct PlaneOptions {
  double min_area = 0.1;         ///< [m^2] >= 0
  std::size_t min_points = 50;   ///< >= 3
  double max_plane_distance = 3; ///< [sigma] of a point to its plane; > 0
  double max_angle = 0.44; ///< [rad] of a point's normal to its plane's; (0, pi/2)
  double merge_gap = 1.0;  ///< [m] between parts of one carrier plane; >= 0
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Makes planes of what a detector believes in (book 7.1.1): each is fitted to
 * its points, claims the points about it (of several planes the nearest wins), falls
 * into connected patches of which small ones are dropped, joins what is part of the
 * same surface, and gets its hulls. What is bent, such as a piece of a sphere, is no
 * plane. In parallel, the same bits for any number of threads.
 * \param[in] candidates disjoint
 * \throws BadArgument an option breaks its rule \ingroup plane_segmentation */
PlaneSegments
finishPlanes(const PlaneCloud& cloud,
             const PlaneCandidates& candidates,
             const PlaneOptions& options = {});

} // namespace pcl6d
