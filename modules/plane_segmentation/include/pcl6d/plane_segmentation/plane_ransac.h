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
  double bend = 0.01; ///< [m] distance allowed in any case, as scans are bent; >= 0
  double max_angle = 0.35;  ///< [rad] between a surfel's normal and the plane's; in (0,
                            ///< pi/2)
  double neighbourhood = 2; ///< [m] size of the neighbourhood for a draw of three
                            ///< points; > 0
  std::size_t min_surfels = 8; ///< of a plane; >= 3
  double probability = 0.99;   ///< of not missing a plane of min_surfels; in (0, 1)
  std::uint64_t seed = 1;      ///< of the draws
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Planes by random samples of three points.
 *
 * The three points are from one cell of an octree, of four sizes in turn, so most
 * samples that touch a plane lie entirely on it. A sample is dropped if the normals of
 * its points contradict its plane. The remaining samples are scored on a few thousand
 * points. The best plane is fitted to its inliers: near points with a normal like the
 * plane's. Of these the largest connected patch counts. It is taken, and its points are
 * removed, once a larger patch would have been drawn with the given probability. The
 * search ends when this is true for the smallest plane of interest.
 *
 * Draws come in blocks with a seed each: equal planes for any number of threads.
 * \return disjoint patches of at least min_surfels surfels; empty if the cloud has no
 * plane
 * \throws BadArgument see RansacPlaneOptions::validate()
 * \note Sources: M. A. Fischler, R. C. Bolles, "Random sample consensus", CACM 24(6),
 * 1981; R. Schnabel, R. Wahl, R. Klein, "Efficient RANSAC for point-cloud shape
 * detection", Computer Graphics Forum 26(2), 2007: local samples, normals, scores on
 * subsets, the chance to have missed a larger plane. Book: 7.1.1.
 * \ingroup plane_segmentation */
PlaneCandidates
ransacCandidates(const PlaneCloud& cloud, const RansacPlaneOptions& options = {});

} // namespace pcl6d
