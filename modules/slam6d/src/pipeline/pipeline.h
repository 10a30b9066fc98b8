// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stage.h"

#include <pcl6d/slam6d/slam_stage.h>

#include <memory>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Runs stages in sequence. A stage changes the result in place; a cancelled or reverted
 * stage leaves the result unchanged.
 * \return false if a stage was cancelled or stopped: later stages did not run */
bool
runStages(const StageList& stages, SlamState& state, SlamContext& context);

/** \brief The user's stages, with their positions. */
using AddedStages =
    std::vector<std::pair<std::shared_ptr<SlamStage>, SlamStage::Place>>;

/** \return all stages of a run in order: the whole of Slam6D::optimize() */
StageList
stagesOfRun(const AddedStages& added);

} // namespace pcl6d::slam6d
