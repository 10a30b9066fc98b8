// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of regionGrowingCandidates(). Distances are in standard deviations of
 * the sensor's noise at the point (PlaneCloud::noise()), so the defaults suit a lidar
 * and a depth camera. */
struct RegionGrowingOptions {
  double max_plane_distance = 3; ///< [sigma] of a surfel to its region's plane; > 0
  double max_rms = 1.5;          ///< [sigma] of a region about its plane; > 0
  double max_angle = 0.35;       ///< [rad] of a normal to the plane's; in (0, pi/2)
  std::size_t min_surfels = 8;   ///< of a region; >= 3
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Planes by region growing. From the smoothest surfel on, the nearest surfel
 * joins if (a) it is a neighbour of the region, (b) it lies on the plane with its
 * normal, and (c) the region stays flat. The plane is updated as the region grows. At
 * the end the region grows again from its final plane, as the first plane of a small
 * region is rough.
 *
 * Grows over surfels instead of points, to average noise and save time.
 * \return sets of points in the order of detection
 * \note Source: J. Poppinga, N. Vaskevicius, A. Birk, K. Pathak, "Fast plane detection
 * and polygonalization in noisy 3D range images", IROS 2008; book 7.1.1.
 * \ingroup plane_segmentation */
PlaneCandidates
regionGrowingCandidates(const PlaneCloud& cloud,
                        const RegionGrowingOptions& options = {});

} // namespace pcl6d
