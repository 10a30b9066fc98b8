// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/folder_job.h"
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

/** \brief Draws mcl.png. \return whether it could be drawn; if not, it was told why */
bool
drawMcl(FolderJob& job, const MclEvaluation& evaluation);

} // namespace pcl6d::app
