// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/folder_job.h"
#include "evaluate/mcl/mcl_evaluation.h"

namespace pcl6d::app {

/** \return rules for the output folder of the verb */
OutputRules
mclFolderRules(const MclSettings& settings);

/** \brief Prints localised and untrusted scans, and the tables. */
void
printMcl(const MclSettings& settings, const MclEvaluation& evaluation);

/** \brief Writes reference.kitti, reference.tum, mcl.csv and mcl.json. */
void
writeMclFiles(const OutputFolder& out,
              const MclSettings& settings,
              const MclEvaluation& evaluation);

/** \brief Draws mcl.png. \return false: drawing failed; a warning has told the reason */
bool
drawMcl(FolderJob& job, const MclEvaluation& evaluation);

} // namespace pcl6d::app
