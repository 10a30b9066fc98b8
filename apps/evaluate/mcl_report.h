// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output_folder.h"
#include "evaluate/mcl_evaluation.h"

namespace pcl6d::app {

/** \return what the verb may do to its output folder */
OutputRules
mclFolderRules(const MclSettings& settings);

/** \brief Prints what was localised and what is not to be trusted, and the tables. */
void
printMcl(const MclSettings& settings, const MclEvaluation& evaluation);

/** \brief Writes reference.kitti, reference.tum, mcl.csv and mcl.json. */
void
writeMclFiles(const OutputFolder& out,
              const MclSettings& settings,
              const MclEvaluation& evaluation);

/** \brief Draws mcl.png; without a display it says so and goes on. */
void
drawMcl(const OutputFolder& out, const MclEvaluation& evaluation, ProgressBar& bar);

} // namespace pcl6d::app
