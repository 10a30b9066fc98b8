// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seen_through.h"

#include <vector>

namespace pcl6d::moving_objects {

/** \brief Things that one run has where the other one saw through, in two runs. */
struct ChangedThings {
  std::vector<Change> vanished, appeared;
  double background = 0; ///< as of RunChanges
};

/** \brief Makes things of gone voxels, leaves out what is too small, a fringe, or may be
 * chance, and counts in the tallies what is left. */
ChangedThings
changedThings(SeenThrough& first,
              SeenThrough& second,
              const RunChangesOptions& options);

/** \return 1 / (1 + N b^n): how sure n patches are no chance, as findChanges() tells */
double
confidenceOf(double places, double background, double patches);

} // namespace pcl6d::moving_objects
