// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/run_changes.h>

#include <vector>

namespace pcl6d::moving_objects {

/** \brief Merges vanished and appeared objects of equal shape, the most similar pair first, and
 * removes both from the lists.
 * \return the moved objects */
std::vector<Change>
takeMoved(std::vector<Change>& vanished,
          std::vector<Change>& appeared,
          const RunChangesOptions& options);

} // namespace pcl6d::moving_objects
