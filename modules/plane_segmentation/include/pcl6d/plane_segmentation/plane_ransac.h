// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of ransacCandidates(). */
struct RansacPlaneOptions {
  double max_plane_distance = 1.5; ///< [sigma] of a surfel to its plane; > 0
  double bend = 0.01;       ///< [m] it may be away in any case, as scans are bent; >= 0
  double max_angle = 0.35;  ///< [rad] between its normal and the plane's; in (0, pi/2)
  double neighbourhood = 2; ///< [m] three points are drawn from so near; > 0
  std::size_t min_surfels = 8; ///< of a plane; >= 3
  double probability = 0.99;   ///< that no such plane is missed; in (0, 1)
  std::uint64_t seed = 1;      ///< of the draws
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Planes by random samples of three points.
 *
 * The three are near each other (a cell of an octree, of four sizes in turns), so that
 * most samples on a plane are wholly on it, and a sample is thrown away unaided by the
 * cloud when the normals of its points contradict its plane. The others are scored on
 * a few thousand points of the cloud. The best is fitted to its inliers, points near it
 * that face its way, of which the largest connected patch counts; it is taken, and its
 * points removed, when a larger one would have been drawn by now with the given
 * probability. The search ends when this holds for the smallest plane of interest.
 *
 * Draws come in blocks with a seed each: the same planes for any number of threads.
 * \return disjoint patches of at least min_points points; none if the cloud has no plane
 * \throws BadArgument see RansacPlaneOptions::validate()
 * \note Sources: M. A. Fischler, R. C. Bolles, "Random sample consensus", CACM 24(6),
 * 1981; R. Schnabel, R. Wahl, R. Klein, "Efficient RANSAC for point-cloud shape
 * detection", Computer Graphics Forum 26(2), 2007: local samples, normals, scores on
 * subsets, the chance to have missed a larger plane. Book: 7.1.1.
 * \ingroup plane_segmentation */
PlaneCandidates
ransacCandidates(const PlaneCloud& cloud, const RansacPlaneOptions& options = {});

} // namespace pcl6d
