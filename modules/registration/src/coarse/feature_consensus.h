// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coarse/feature_matching.h"
#include "coarse/placement_distance.h"

#include <cstdint>
#include <vector>

namespace pcl6d::registration {

/** \brief A motion supported by many matches. */
struct Hypothesis {
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  double score = 0; ///< higher is better; here the number of supporting matches
};

/** \brief Keeps the best of each group of close hypotheses.
 * \return best first, ties in the order given, at most max_count, any two farther apart
 * than min_distance [m] */
std::vector<Hypothesis>
keepDistinct(std::vector<Hypothesis> hypotheses,
             const PlacementDistance& distance,
             double min_distance,
             std::size_t max_count);

struct ConsensusOptions {
  double tolerance = 0;  ///< [m] largest residual of a supporting match
  double min_length = 0; ///< [m] closer points fix no rotation
  std::size_t draws = 4000;
  std::uint64_t seed = 0;
  unsigned int num_threads = 0;
};

/** \brief Motions from matches with a majority of outliers.
 *
 * Two matches are compatible when a rigid motion can satisfy both: equal distances and
 * equal angles of the normals. Triples of compatible matches are drawn, each time the
 * best connected of a few, since correct matches share many compatible matches and
 * outliers few; each triple gives a motion in closed form, refined on the supporting
 * matches. The draws depend only on the seed and their number.
 * \return the hypotheses of the successful draws, unsorted
 * \note Source: the second-order count of common compatible matches follows Z. Chen, K.
 * Sun, F. Yang, W. Tao, "SC2-PCR", CVPR 2022; drawing and counting, M. A. Fischler, R.
 * C. Bolles, "Random sample consensus", CACM 24(6), 1981. */
std::vector<Hypothesis>
drawHypotheses(const FeatureScan& target,
               const FeatureScan& source,
               const std::vector<FeatureMatch>& matches,
               const ConsensusOptions& options);

} // namespace pcl6d::registration
