// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/common/export.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief When the reference comes back to a place. \ingroup benchmarking */
struct RevisitOptions {
  double radius = 2;    ///< [m] largest distance of the two positions; > 0
  double min_path = 20; ///< [m] shortest way in between; >= 0

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Two rows of compared poses, first < second, between which the drive closed a
 * loop. */
using Revisit = std::pair<std::size_t, std::size_t>;

/** \brief Finds where the reference comes back: for each compared pose the nearest earlier
 * one within the radius from which the way was long enough, if there is one; of equally
 * near ones the first. O(n^2) time. */
std::vector<Revisit>
findRevisits(const Trajectory& reference,
             const std::vector<PosePair>& pairs,
             const RevisitOptions& options = RevisitOptions());

/** \brief Revisits given by indices of reference poses, as rows of the compared ones.
 * \throws BadArgument a pose is not compared, or a pair holds the same pose twice */
std::vector<Revisit>
revisitsOf(const std::vector<std::pair<std::size_t, std::size_t>>& reference_indices,
           const std::vector<PosePair>& pairs);

/** \brief Loop closure errors: those of the relative poses across the loops, which an open
 * loop shows in full and a bent one hides, wherever it is bent. `path` is the way around.
 * \throws BadArgument a row or a pair is outside */
RelativeErrors
loopClosureErrors(const Trajectory& estimate,
                  const Trajectory& reference,
                  const std::vector<PosePair>& pairs,
                  const std::vector<Revisit>& revisits);

} // namespace pcl6d
