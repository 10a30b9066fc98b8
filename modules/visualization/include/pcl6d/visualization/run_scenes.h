// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/visualization/plane_view.h>
#include <pcl6d/visualization/top_view.h>

/** \file What a run left, as scenes that can be drawn. */
namespace PCL6D_EXPORTS pcl6d {

/** \return the map of a run, what moved and both trajectories, relative to its world offset
 * \throws IoFailed map.pcd or moving.pcd is broken \ingroup visualization */
TopViewScene
topSceneOf(const RunFolder& run);

/** \return the planes of a run with their points, or those of its map where it has none,
 * relative to its world offset; each is seen from the nearest pose
 * \throws IoFailed a file is broken \ingroup visualization */
PlaneViewScene
planeSceneOf(const RunFolder& run);

} // namespace pcl6d
