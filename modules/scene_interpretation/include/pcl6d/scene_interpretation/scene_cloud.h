// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/run/registered_scans.h>

#include <cstddef>
#include <vector>

/** \file The input points of PlaneFinder. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A cloud for plane detection: one scan in its frame, or a map. */
struct SceneCloud {
  Points points;         ///< [m]
  std::size_t width = 0; ///< > 1: the points are a grid, in rows of this length
  Points viewpoints;     ///< [m] per point the sensor's position; empty: origin
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero(); ///< [m] of the points
};

/** \return the cloud of a map; its scan numbers are indices into poses
 * \param[in] poses of the scans, T_world_scan in full coordinates
 * \param[in] world_offset [m] of the points
 * \ingroup scene_interpretation */
SceneCloud
sceneCloudOf(const MapBuilder& map,
             const std::vector<Eigen::Isometry3d>& poses,
             const Eigen::Vector3d& world_offset);

/** \brief Range gate and voxel for joinScans(): missing options are taken from the run,
 * or derived from the first scans.
 * \param[in] progress called before each scan is read; its exceptions pass through
 * \throws BadArgument an option is invalid \throws IoFailed a scan cannot be read */
ScanParameters
sceneParameters(const RegisteredScans& scans,
                const ScanParameterOptions& given = {},
                const ProgressCallback& progress = {});

/** \brief Joins the scans of a folder or a run, one point per voxel.
 * \param[in] progress called with each scan ("reading"); its exceptions pass through
 * \throws IoFailed a scan cannot be read */
SceneCloud
joinScans(const RegisteredScans& scans,
          const ScanParameters& parameters,
          const ProgressCallback& progress = {});

} // namespace pcl6d
