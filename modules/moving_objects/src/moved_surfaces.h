// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/run_changes.h>

#include <vector>

namespace pcl6d::moving_objects {

/** \brief Areas whose distance chance would not give, but for what is next to things.
 * \param[in] first, second at core points of either run, to the other one */
std::vector<Change>
movedSurfaces(const std::vector<SurfaceDistance>& first,
              const std::vector<SurfaceDistance>& second,
              const std::vector<Change>& things,
              const RunChangesOptions& options);

} // namespace pcl6d::moving_objects
