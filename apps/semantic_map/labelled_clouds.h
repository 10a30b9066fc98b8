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

/** \brief Writes the map of a run with the fields label, plane_id, object_id and rgb, the
 * colour of the label; fields that the map has already are kept.
 * \param[in] file .pcd or .ply \param[in] label_names by number
 * \throws IoFailed it cannot be written */
void
writeLabelledMap(const std::filesystem::path& file,
                 const Scan& map,
                 const PointLabels& labels,
                 const std::vector<std::string>& label_names);

} // namespace pcl6d::app
