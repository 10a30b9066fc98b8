// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Voting scheme of houghCandidates(). */
enum class HoughVariant {
  kRandomized,    ///< three points at a time, for the plane through them
  kProbabilistic, ///< a random part of the points, each for every plane through it
  kStandard,      ///< every point, for every plane through it
  kAdaptive,      ///< random points until the largest peaks are stable
  kProgressive    ///< random points until a peak exceeds chance; its points then stop
                  ///< voting
};

/** \return the variant called "standard", "probabilistic", "randomized", "adaptive" or
 * "progressive" \throws BadArgument another name */
HoughVariant
houghVariantFromName(const std::string& name);

/** \return the names of the variants */
std::vector<std::string>
houghVariantNames();

/** \return the variant's name */
std::string
toString(HoughVariant variant);

/** \brief Knobs of houghCandidates(). */
struct HoughPlaneOptions {
  HoughVariant variant = HoughVariant::kRandomized;
  int slices = 45;                 ///< of the AccumulatorBall: cells of pi / slices
  double offset_cell = 0.1;        ///< [m] size of a cell along the normal; > 0
  double max_plane_distance = 1.5; ///< [sigma] of a surfel to its plane; > 0
  double bend = 0.01; ///< [m] distance allowed in any case, as scans are bent; >= 0
  double max_angle = 0.35; ///< [rad] between a surfel's normal and the plane's; in (0,
                           ///< pi/2)
  std::size_t min_surfels = 8; ///< of a plane; >= 3
  /// \name Randomized
  ///@{
  double min_side = 0.1; ///< [m] between every two of three points; >= 0
  double max_side = 2;   ///< [m] edge of the cell to draw from; > min_side
  int votes = 20;        ///< needed before a plane is tested; >= 2
  int max_draws = 5000;  ///< before the plane with most votes is tested; >= 1
  int max_failures = 20; ///< successive rejected planes that end the search; >= 1
  ///@}
  double share = 0.3; ///< of points that vote in the probabilistic variant; in (0, 1]
  /// \name Adaptive
  ///@{
  int peaks = 5;          ///< number of largest peaks that must be stable; >= 1
  int stable_batches = 3; ///< of a twentieth of the points each; >= 1
  ///@}
  /** Progressive: significance of a peak, the probability of its votes if the votes for
   * its direction were spread evenly over the cloud; in (0, 1) */
  double chance = 1e-6;
  std::uint64_t seed = 1; ///< of the draws
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Planes by votes in cells of normal (AccumulatorBall) and offset.
 *
 * Randomized: three near points vote for their plane if their normals agree with it.
 * When a cell has enough votes, their mean plane is fitted to its inliers: near points
 * with a normal like the plane's. The largest connected patch becomes a candidate, its
 * points are removed, and the count restarts. Only cells with votes take memory.
 *
 * Standard and probabilistic: each point votes for every plane through it with a normal
 * within max_angle of the point's. The largest count in a window of 9 x 9 x 9 cells is
 * a peak. Peaks are fitted as above, then the remaining points vote again, until no
 * peak is a plane. Adaptive: points vote in random order, and peaks are taken when the
 * largest are stable under further votes.
 *
 * Progressive: points vote in random order, too, but a cell is tested when it has more
 * votes than chance explains. The points of its plane are removed with their votes, so
 * remaining planes emerge sooner.
 *
 * Votes include the side of the plane that faces the sensor. So the two faces of a wall
 * are two planes, and a plane through the origin is not split into (n, rho) and (-n,
 * -rho).
 * \return disjoint patches of at least min_surfels surfels; empty if the cloud has no
 * plane
 * \throws BadArgument see HoughPlaneOptions::validate()
 * \note Source: see AccumulatorBall; adaptive: A. Ylä-Jääski, N. Kiryati, "Adaptive
 * termination of voting in the probabilistic circular Hough transform", PAMI 16(9),
 * 1994; progressive: J. Matas, C. Galambos, J. Kittler, "Robust detection of lines
 * using the progressive probabilistic Hough transform", CVIU 78(1), 2000. Book: 7.1.1.
 * \ingroup plane_segmentation */
PlaneCandidates
houghCandidates(const PlaneCloud& cloud, const HoughPlaneOptions& options = {});

} // namespace pcl6d
