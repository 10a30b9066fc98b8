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

/** \brief Joins the scans of a folder at their poses in one file, with all their points
 * and the memory of one scan: they are read twice, to count the points and to write them.
 * \return the exit code */
int
joinScans(const ScanSettings& settings);

} // namespace pcl6d::app
