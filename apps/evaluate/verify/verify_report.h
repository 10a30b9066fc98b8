// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/folder_job.h"
#include "evaluate/verify/verify_source.h"

#include <pcl6d/common/map_verification.h>

namespace pcl6d::app {

/** \brief The verdict on a map. */
MapVerification
verifyMap(const VerifySettings& settings, const VerifySource& source);

/** \brief Verifies the pose of two scans as a map of two scans. */
MapVerification
verifyPair(const VerifySource& source);

/** \brief Prints the links, the most doubtful first, and the verdict in words. */
void
printVerification(const VerifySettings& settings,
                  const VerifySource& source,
                  const MapVerification& map);

/** \return rules for the output folder of the verb */
OutputRules
verifyFolderRules(const VerifySettings& settings);

/** \brief Writes verification.csv, verification.json and contradictions.ply, publishes
 * them, and draws contradictions.png.
 * \return false: drawing failed; a warning has told the reason */
bool
publishVerification(FolderJob& job,
                    const VerifySettings& settings,
                    const VerifySource& source,
                    const MapVerification& map);

} // namespace pcl6d::app
