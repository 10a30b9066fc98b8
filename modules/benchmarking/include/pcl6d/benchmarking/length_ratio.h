// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/common/export.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The distance of the same two points in two sources [m], or each in a unit of
 * its own. */
struct LengthPair {
  double estimate = 0;
  double reference = 0;
};

/** \brief Evaluation by length ratios, which needs no common scale or frame. */
struct LengthRatioErrors {
  ErrorStatistics
      ratio;        ///< |(e_k / e_l) / (r_k / r_l) - 1| over all k < l; index_of_max
                    ///< counts them in the order (0, 1), (0, 2), ..., (1, 2), ...
  double scale = 1; ///< median of e / r: 1 if both have one scale
};

/** \brief Compares the ratio of each two lengths with that in the other source.
 * \param[in] lengths each finite and > 0
 * \return zeros for fewer than two lengths
 * \throws BadArgument a length breaks its rule
 * \note Source: book, 6.1.3 to 6.1.5. \ingroup benchmarking */
LengthRatioErrors
lengthRatioErrors(const std::vector<LengthPair>& lengths);

/** \brief Lengths from positions: the distances between at most 16 of the compared poses,
 * evenly spread over their order. Those shorter in the reference than a tenth of the
 * longest are left out, as they tell of noise only, and so are those that are 0 in the
 * estimate.
 * \throws BadArgument a pair points outside a trajectory */
std::vector<LengthPair>
poseDistances(const Trajectory& estimate,
              const Trajectory& reference,
              const std::vector<PosePair>& pairs);

} // namespace pcl6d
