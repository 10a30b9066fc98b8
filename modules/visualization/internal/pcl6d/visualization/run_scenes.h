// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/visualization/plane_view.h>
#include <pcl6d/visualization/top_view.h>

/** \file Results of a run as scenes for drawing. */
namespace PCL6D_EXPORTS pcl6d {

/** \return the map of a run, its dynamic points and both trajectories, relative to its
 * world offset
 * \throws IoFailed map.pcd or moving.pcd is broken \ingroup visualization */
TopViewScene
topSceneOf(const RunFolder& run);

/** \return the planes of a run with their points, or else the planes of its map,
 * relative to its world offset; each plane is seen from the nearest pose
 * \throws IoFailed a file is broken \ingroup visualization */
PlaneViewScene
planeSceneOf(const RunFolder& run);

} // namespace pcl6d
