// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>
#include <pcl6d/benchmarking/pose_matching.h>
#include <pcl6d/common/export.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The distance of two points in two sources, both in [m] or each in its own unit. */
struct LengthPair {
  double estimate = 0;
  double reference = 0;
};

/** \brief Errors of length ratios, which need no common scale or frame. */
struct LengthRatioErrors {
  ErrorStatistics
      ratio;        ///< |(e_k / e_l) / (r_k / r_l) - 1| over all k < l; index_of_max
                    ///< counts them in the order (0, 1), (0, 2), ..., (1, 2), ...
  double scale = 1; ///< median of e / r: 1 for a common scale
};

/** \brief Compares the ratio of every two lengths between the two sources.
 * \param[in] lengths each finite and > 0
 * \return zeros for fewer than two lengths
 * \throws BadArgument a length is not finite or not > 0
 * \note Source: book, 6.1.3 to 6.1.5. \ingroup benchmarking */
LengthRatioErrors
lengthRatioErrors(const std::vector<LengthPair>& lengths);

/** \brief Lengths from positions: the distances between at most 16 of the compared
 * poses, evenly spread over their order. Reference lengths below a tenth of the longest
 * are left out, as they measure mostly noise, and also lengths of 0 in the estimate.
 * \throws BadArgument a pair points outside a trajectory */
std::vector<LengthPair>
poseDistances(const Trajectory& estimate,
              const Trajectory& reference,
              const std::vector<PosePair>& pairs);

} // namespace pcl6d
