// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/moving_objects/run_changes.h>

#include <vector>

namespace pcl6d::moving_objects {

/** \brief Makes one of each vanished and appeared thing that have equal shape, the most alike
 * first; they leave the lists. \return what moved */
std::vector<Change>
takeMoved(std::vector<Change>& vanished,
          std::vector<Change>& appeared,
          const RunChangesOptions& options);

} // namespace pcl6d::moving_objects
