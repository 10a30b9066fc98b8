// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "semantic_map/finished_run.h"

#include <pcl6d/semantic_map/point_labels.h>

#include <filesystem>

namespace pcl6d::app {

/** \brief Finds out which scans saw the planes and objects of a map: those with at least 10
 * points on them. Objects that tell by which scans they were seen keep these. */
void
findScansOfParts(const FinishedRun& run,
                 const PointLabeller& labeller,
                 ProgressBar& bar,
                 SemanticMap& map);

/** \return the points of a cloud that carry the label floor */
Points
floorPoints(const Points& points, const PointLabels& labels);

/** \brief Writes the map of a run with the fields label, plane_id and object_id.
 * \param[in] file .pcd or .ply \throws IoFailed it cannot be written */
void
writeLabelledMap(const std::filesystem::path& file,
                 const Scan& map,
                 const PointLabels& labels);

} // namespace pcl6d::app
