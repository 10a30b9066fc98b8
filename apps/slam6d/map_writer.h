// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/run_writer.h"

#include <pcl6d/slam6d/map_builder.h>

namespace pcl6d::app {

/** \return "scan007" for the seventh scan of a folder (counted from 0), as in the names of
 * the files that a run writes */
std::string
scanName(const ScanFolder& folder, std::size_t i);

/** \brief Writes scans/ (all input points, with the final pose as VIEWPOINT) and map.pcd
 * (the reduced union of what passed the range gate). \return the map */
MapBuilder
writeScansAndMap(const Settings& settings,
                 const ScanFolder& folder,
                 const Slam6DResult& result,
                 ProgressBar& bar,
                 const OutputFolder& out,
                 Run& run);

/** \brief Draws top_view.png. Without a display the run goes on and says so. */
void
drawTopView(const MapBuilder& map,
            const ScanFolder& folder,
            const Slam6DResult& result,
            ProgressBar& bar,
            const OutputFolder& out,
            Run& run);

} // namespace pcl6d::app
