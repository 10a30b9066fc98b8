// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Criteria of a plane, common to every detector. Distances in standard
 * deviations use the sensor's noise at the point (PlaneCloud::noise()). */
struct PlaneOptions {
  double min_area = 0.1;         ///< [m^2] >= 0
  std::size_t min_points = 50;   ///< >= 3
  double max_plane_distance = 3; ///< [sigma] of a point to its plane; > 0
  double max_angle = 0.44; ///< [rad] of a point's normal to its plane's; (0, pi/2)
  double merge_gap = 1.0;  ///< [m] between parts of one carrier plane; >= 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Turns candidates of a detector into planes (book 7.1.1). A plane is fitted to
 * each candidate and claims the points around it; between several planes the nearest
 * wins. Each plane is split into connected patches, small patches are dropped, parts of
 * one surface are merged, and hulls are added. Bent patches, such as pieces of a
 * sphere, are dropped. Runs in parallel; bit for bit equal for any number of threads.
 * \param[in] candidates disjoint
 * \throws BadArgument an option is invalid \ingroup plane_segmentation */
PlaneSegments
finishPlanes(const PlaneCloud& cloud,
             const PlaneCandidates& candidates,
             const PlaneOptions& options = {});

} // namespace pcl6d
