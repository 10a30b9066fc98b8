// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Who votes in houghCandidates(). */
enum class HoughVariant {
  kRandomized,    ///< three points at a time, for the one plane through them
  kProbabilistic, ///< some of the points, each for all planes through it
  kStandard,      ///< all points, each for all planes through it
  kAdaptive,      ///< as many as it takes until the largest peaks stay the same
  kProgressive    ///< until a peak is more than chance; its points vote no more
};

/** \return the variant called "standard", "probabilistic", "randomized", "adaptive" or
 * "progressive" \throws BadArgument another name */
HoughVariant
houghVariantFromName(const std::string& name);

/** \return the names of all variants */
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
  double bend = 0.01;      ///< [m] it may be away in any case, as scans are bent; >= 0
  double max_angle = 0.35; ///< [rad] between its normal and the plane's; in (0, pi/2)
  std::size_t min_surfels = 8; ///< of a plane; >= 3
  /// \name Randomized
  ///@{
  double min_side = 0.1; ///< [m] between each two of three points; >= 0
  double max_side = 2;   ///< [m] edge of the cell that they are drawn from; > min_side
  int votes = 20;        ///< for a plane that is looked at; >= 2
  int max_draws = 5000;  ///< then the plane with most votes is looked at; >= 1
  int max_failures = 20; ///< planes in turn that were none: the end; >= 1
  ///@}
  double share = 0.3; ///< of the points that vote if probabilistic; in (0, 1]
  /// \name Adaptive
  ///@{
  int peaks = 5;          ///< the largest so many are to stay the same; >= 1
  int stable_batches = 3; ///< of a twentieth of the points each; >= 1
  ///@}
  /** Progressive: the probability by which a cell has so many votes if the votes for its
   * direction lie anywhere in the cloud; in (0, 1) */
  double chance = 1e-6;
  std::uint64_t seed = 1; ///< of the draws
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Planes by votes in cells of normal (AccumulatorBall) and offset.
 *
 * Randomized: three points near each other vote for their plane if their normals suit
 * it. As soon as a cell has enough votes, the mean plane of its votes is fitted to its
 * inliers, points near it that face its way; the largest connected patch is taken, its
 * points are removed, and the count starts anew. Only cells with votes take memory.
 *
 * Standard and probabilistic: each point votes for all planes through it whose normal is
 * within max_angle of its own. The largest count in a window of 9 x 9 x 9 cells is a
 * peak; peaks are fitted as above, then the points that are left vote again, until no
 * peak is a plane. Adaptive: points vote in an order of chance, and the peaks are taken as
 * soon as the largest ones stay the same while more points vote.
 *
 * Progressive: points vote in an order of chance too, but a cell is looked at as soon as
 * it has more votes than chance explains; the points of its plane are removed together
 * with their votes, so that what is left stands out sooner.
 *
 * Votes know the side from which their plane is seen. So the two faces of a wall are two
 * planes, and a plane through the origin is not parted into (n, rho) and (-n, -rho).
 * \return disjoint patches of at least min_points points; none if the cloud has no plane
 * \throws BadArgument see HoughPlaneOptions::validate()
 * \note Source: see AccumulatorBall; adaptive: A. Ylä-Jääski, N. Kiryati, "Adaptive
 * termination of voting in the probabilistic circular Hough transform", PAMI 16(9), 1994;
 * progressive: J. Matas, C. Galambos, J. Kittler, "Robust detection of lines using the
 * progressive probabilistic Hough transform", CVIU 78(1), 2000. Book: 7.1.1. \ingroup plane_segmentation */
PlaneCandidates
houghCandidates(const PlaneCloud& cloud, const HoughPlaneOptions& options = {});

} // namespace pcl6d
