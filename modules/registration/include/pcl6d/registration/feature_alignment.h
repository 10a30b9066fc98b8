// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/registration/coarse_estimate.h>

#include <cstdint>
#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Knobs of alignByFeatures(). What is not given follows from the data. */
struct FeatureAlignmentOptions {
  std::optional<double> voxel; ///< [m] edge of the reduction of both scans; > 0. None:
                               ///< 2.5 median spacings, at least a sixtieth of the
                               ///< median range, at least what leaves 5000 points
  std::optional<double> feature_radius; ///< [m] what a feature describes; > 0; none: 7
                                        ///< voxels
  double min_overlap = 0.3;      ///< share of either scan that must meet; in [0, 1]
  double min_consistency = 0.95; ///< the least of met / (met + seen through); in [0, 1]
  double max_ambiguity = 0.95;   ///< second score / score that is accepted; in [0, 1]
  std::uint64_t seed = 0;        ///< of the random draws
  unsigned int num_threads = 0;  ///< 0: one per core; never changes the result
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Places one scan on another without any guess.
 *
 * Both scans are reduced to voxels, get normals towards their scanners and PCL's FPFH
 * features. Pairs of points that are each other's most similar one are the matches.
 * Compatible triples of them are drawn, and each gives a motion. The motions are judged
 * by the points themselves: by the share of a scan that meets the other with like
 * normals, times the consistency, since a point that lies where the other scan looked
 * through denies the placement. The best are refined by ICP and judged again. That
 * product is the score.
 *
 * kOk means: enough overlap, little that denies it, and no placement as good nearby
 * (along the direction that the surfaces hold least) or elsewhere. Still a guess for
 * ICP, good to about a voxel.
 * \param[in] target, source points [m] in the frames of their scanners, from whose
 * origins they were seen (a robot's frame will do if the scanner is near its origin);
 * points that are not finite, and the range that stands for "no echo", are left out
 * \return never throws on data. kTooFewPairs (with the identity): no matches, or
 * the best placement misses min_overlap or min_consistency; kRankDeficient: it is as good
 * as another
 * \throws BadArgument an option breaks its rule
 * \note Sources: R. B. Rusu, N. Blodow, M. Beetz, ICRA 2009 (FPFH); Z. Chen et al.,
 * CVPR 2022 (compatibility of second order). \ingroup registration */
CoarseEstimate
alignByFeatures(const Points& target,
                const Points& source,
                const FeatureAlignmentOptions& options = {});

} // namespace pcl6d
