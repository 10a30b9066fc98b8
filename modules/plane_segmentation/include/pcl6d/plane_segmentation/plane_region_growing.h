// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of regionGrowingCandidates(). Distances count in standard deviations of
 * the sensor's noise where a point is (PlaneCloud::noise()), so that the defaults suit
 * a lidar as well as a depth camera. */
struct RegionGrowingOptions {
  double max_plane_distance = 3; ///< [sigma] of a surfel to its region's plane; > 0
  double max_rms = 1.5;          ///< [sigma] of a region about its plane; > 0
  double max_angle = 0.35;       ///< [rad] of a normal to the plane's; in (0, pi/2)
  std::size_t min_surfels = 8;   ///< of a region; >= 3
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Planes by region growing: from the smoothest place on, the nearest neighbour
 * joins as long as (a) it is a neighbour, (b) it lies on the plane, with its normal, and
 * (c) the region stays flat. The plane is updated as the region grows; once done, the
 * region grows again from its final plane, which a small start knew but roughly.
 *
 * It grows over surfels and not points, which averages noise and saves most of the
 * time. \return sets of points in the order in which they were found
 * \note Source: J. Poppinga, N. Vaskevicius, A. Birk, K. Pathak, "Fast plane detection
 * and polygonalization in noisy 3D range images", IROS 2008; book 7.1.1.
 * \ingroup plane_segmentation */
PlaneCandidates
regionGrowingCandidates(const PlaneCloud& cloud,
                        const RegionGrowingOptions& options = {});

} // namespace pcl6d
