// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/coarse_estimate.h>

#include <cstdint>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of alignByFeatures(). Missing values follow from the data. */
struct FeatureAlignmentOptions {
  std::optional<double> voxel; ///< [m] edge of the reduction of both scans; > 0.
                               ///< Missing: 2.5 median spacings, at least a sixtieth of
                               ///< the median range, and large enough to leave about
                               ///< 5000 points at most
  std::optional<double> feature_radius; ///< [m] of the neighbourhood of a feature; > 0;
                                        ///< missing: 7 voxels
  double min_overlap = 0.3;             ///< least share of either scan with
                                        ///< partners; in [0, 1]
  double min_consistency = 0.95; ///< the least of met / (met + seen through); in [0, 1]
  double max_ambiguity = 0.95;   ///< largest accepted second score / score; in [0, 1]
  std::uint64_t seed = 0;        ///< of the random draws
  unsigned int num_threads = 0;  ///< 0: a thread per core; never changes the result
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Registers a scan with another without an initial pose.
 *
 * Both scans are reduced to voxels, get normals towards their scanners and PCL's FPFH features.
 * Pairs of mutually most similar points are the matches. Compatible triples of matches are
 * drawn, and each triple gives a motion. The score of a motion is the share of points of a scan
 * with a partner of like normal in the other scan, times the consistency: a point in the
 * measured free space of the other scan contradicts the placement. The best motions are refined
 * by ICP and scored again.
 *
 * kOk means: enough overlap, few contradictions, and no equally good placement nearby (along the
 * direction least fixed by the surfaces) or elsewhere. The result is an initial pose for ICP, good
 * to about a voxel.
 * \param[in] target, source points [m] in the frames of their scanners, measured from the origin (a
 * robot's frame will do with the scanner near its origin); points that are not finite, and points
 * at the range that means "no echo", are left out
 * \return never throws on data. kTooFewPairs (with the identity): no matches, or the best placement
 * misses min_overlap or min_consistency; kRankDeficient: another placement is equally good
 * \throws BadArgument an option is invalid
 * \note Sources: R. B. Rusu, N. Blodow, M. Beetz, ICRA 2009 (FPFH); Z. Chen et al.,
 * CVPR 2022 (compatibility of second order). \ingroup registration */
CoarseEstimate
alignByFeatures(const Points& target,
                const Points& source,
                const FeatureAlignmentOptions& options = {});

} // namespace pcl6d
