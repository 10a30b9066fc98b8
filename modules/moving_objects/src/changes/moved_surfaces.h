// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/run_changes.h>

#include <vector>

namespace pcl6d::moving_objects {

/** \brief Areas with a distance too large for chance, except next to objects.
 * \param[in] first, second at core points of either run, to the other run */
std::vector<Change>
movedSurfaces(const std::vector<SurfaceDistance>& first,
              const std::vector<SurfaceDistance>& second,
              const std::vector<Change>& things,
              const RunChangesOptions& options);

} // namespace pcl6d::moving_objects
