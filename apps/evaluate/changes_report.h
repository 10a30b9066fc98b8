// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/folder_job.h"
#include "evaluate/changes_world.h"

#include <pcl6d/moving_objects/run_changes.h>

namespace pcl6d::app {

/** \brief What is told of a comparison. */
struct ChangesReport {
  const ChangesSettings& settings;
  const ComparedRuns& runs;
  const CommonWorld& world;
  const RunChanges& found;
};

/** \brief Prints how the runs lie on each other, the changes, and how much was compared. */
void
printChanges(const ChangesReport& report);

/** \return what the verb does to its folder */
OutputRules
changesFolderRules(const ChangesSettings& settings);

/** \brief Writes all numbers (share/doc/changes.md). \throws IoFailed it cannot be written */
void
writeChangesJson(const std::filesystem::path& path, const ChangesReport& report);

/** \brief Writes changes.json and changes.ply, publishes them, and draws changes.png.
 * \return whether that could be drawn; if not, it was told why */
bool
publishChanges(FolderJob& job, const ChangesReport& report);

} // namespace pcl6d::app
