// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "seen_through.h"

#include <vector>

namespace pcl6d::moving_objects {

/** \brief Objects of either run in the free space of the other. */
struct ChangedThings {
  std::vector<Change> vanished, appeared;
  double background = 0; ///< as of RunChanges
};

/** \brief Clusters gone voxels to objects, removes objects that are too small, a fringe, or
 * probably chance, and counts the remaining objects in the tallies. */
ChangedThings
changedThings(SeenThrough& first,
              SeenThrough& second,
              const RunChangesOptions& options);

/** \return 1 / (1 + N b^n): the confidence that n patches are not by chance, see findChanges() */
double
confidenceOf(double places, double background, double patches);

} // namespace pcl6d::moving_objects
