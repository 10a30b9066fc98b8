// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/folder_job.h"
#include "evaluate/verify_source.h"

#include <pcl6d/common/map_verification.h>

namespace pcl6d::app {

/** \brief The verdict on a map. */
MapVerification
verifyMap(const VerifySettings& settings, const VerifySource& source);

/** \brief The verdict on the pose of two scans, as that of a map of two. */
MapVerification
verifyPair(const VerifySource& source);

/** \brief Prints the links, the most doubtful first, and the verdict in words. */
void
printVerification(const VerifySettings& settings,
                  const VerifySource& source,
                  const MapVerification& map);

/** \return what the verb does to its folder */
OutputRules
verifyFolderRules(const VerifySettings& settings);

/** \brief Writes verification.csv, verification.json and contradictions.ply, publishes them,
 * and draws contradictions.png.
 * \return whether that could be drawn; if not, it was told why */
bool
publishVerification(FolderJob& job,
                    const VerifySettings& settings,
                    const VerifySource& source,
                    const MapVerification& map);

} // namespace pcl6d::app
