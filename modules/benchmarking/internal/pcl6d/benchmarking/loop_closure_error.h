// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/common/export.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Criteria of a revisit of the reference. \ingroup benchmarking */
struct RevisitOptions {
  double radius = 2;    ///< [m] largest distance of the two positions; > 0
  double min_path = 20; ///< [m] shortest way in between; >= 0

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Two rows of compared poses, first < second, that close a loop. */
using Revisit = std::pair<std::size_t, std::size_t>;

/** \brief Finds revisits in the reference: for each compared pose the nearest earlier
 * pose within the radius, with a path between them that is long enough; of equally near
 * poses the first. O(n^2) time. */
std::vector<Revisit>
findRevisits(const Trajectory& reference,
             const std::vector<PosePair>& pairs,
             const RevisitOptions& options = RevisitOptions());

/** \brief Revisits given by indices of reference poses, as rows of the compared poses.
 * \throws BadArgument a pose is not compared, or both indices of a pair are equal */
std::vector<Revisit>
revisitsOf(const std::vector<std::pair<std::size_t, std::size_t>>& reference_indices,
           const std::vector<PosePair>& pairs);

/** \brief Loop closure errors: errors of the relative poses across the loops. An open
 * loop shows its full error; a bent but closed loop shows no error, wherever the bend
 * is. `path` is the length of the loop.
 * \throws BadArgument a row or a pair is outside */
RelativeErrors
loopClosureErrors(const Trajectory& estimate,
                  const Trajectory& reference,
                  const std::vector<PosePair>& pairs,
                  const std::vector<Revisit>& revisits);

} // namespace pcl6d
