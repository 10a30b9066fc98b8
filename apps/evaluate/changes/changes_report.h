// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/folder_job.h"
#include "evaluate/changes/changes_world.h"

#include <pcl6d/moving_objects/run_changes.h>

namespace pcl6d::app {

/** \brief Content of the report of a comparison. */
struct ChangesReport {
  const ChangesSettings& settings;
  const ComparedRuns& runs;
  const CommonWorld& world;
  const RunChanges& found;
};

/** \brief Prints the alignment of the runs, the changes, and the compared share. */
void
printChanges(const ChangesReport& report);

/** \return rules for the output folder of the verb */
OutputRules
changesFolderRules(const ChangesSettings& settings);

/** \brief Writes every number (share/doc/changes.md). \throws IoFailed writing failed */
void
writeChangesJson(const std::filesystem::path& path, const ChangesReport& report);

/** \brief Writes changes.json and changes.ply, publishes them, and draws changes.png.
 * \return false: drawing failed; a warning has told the reason */
bool
publishChanges(FolderJob& job, const ChangesReport& report);

} // namespace pcl6d::app
