// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/scan_settings.h"

namespace pcl6d::app {

/** \brief Converts a scan. \return the exit code */
int
convertFile(const ScanSettings& settings);

/** \brief Converts the scans of a folder one after the other. \return the exit code */
int
convertFolder(const ScanSettings& settings);

/** \brief Writes a scan, or the scans of a folder or of an E57 file, to an E57 file.
 * \return the exit code */
int
convertToE57(const ScanSettings& settings);

/** \brief Joins the scans of a folder at their poses in one file with every point.
 * Needs memory for one scan only: each scan is read twice, for counting and for writing
 * points.
 * \return the exit code */
int
joinScans(const ScanSettings& settings);

} // namespace pcl6d::app
