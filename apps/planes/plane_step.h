// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output_folder.h"
#include "planes/plane_settings.h"

#include <pcl6d/slam6d/map_builder.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief A cloud to look for planes in: one scan in its frame, or a map. */
struct PlaneStepCloud {
  pcl::PCLPointCloud2 cloud; ///< all fields, to be written with the planes
  Points points;             ///< [m] x, y, z of it
  std::size_t width = 0;     ///< > 1: the points are a grid, in rows of this length
  Points viewpoints;         ///< [m] per point where it was seen from; empty: origin
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero(); ///< [m] of the points
};

/** \return the edge [m] of the voxels in which a map keeps one point, for planes:
 * matching needs few points, small planes more */
inline double
planeVoxel(double matching_voxel)
{
  return matching_voxel / 3;
}

/** \return the cloud of a map, whose scan numbers are places in poses
 * \param[in] poses of the scans, T_world_scan in full coordinates */
PlaneStepCloud
planeCloudOf(const MapBuilder& map,
             const std::vector<Eigen::Isometry3d>& poses,
             const Eigen::Vector3d& world_offset);

/** \brief What was found in it. */
struct PlaneStepResult {
  PlaneSegments segments; ///< with labels; refined, if asked for
  Interpretation interpretation;
  std::optional<RefinedModel> refined;
  double seconds = 0; ///< from the points to the labelled planes
};

/** \brief Finds, labels and refines the planes of a cloud.
 * \throws BadArgument an option breaks its rule */
PlaneStepResult
findPlanes(const PlaneStepCloud& cloud,
           const PlaneStepOptions& options,
           unsigned int num_threads);

/** \return planes in the full coordinates of the world
 * \param[in] world_offset [m] that their points are relative to */
std::vector<Plane>
worldPlanes(const std::vector<PlaneSegment>& segments,
            const Eigen::Vector3d& world_offset);

/** \return the names of the files that writePlaneFiles() leaves, as a regular expression
 */
std::string
planeFilePattern();

/** \brief Writes planes.json (in the full coordinates of the world; refined ones, if there
 * are), planes.pcd, hulls.ply, planes.png, with labels labels.json and, if refined,
 * refinement.json and refined.pcd.
 * \param[in] generator the program, as it stands in planes.json
 * \return warnings, such as that no picture could be drawn */
std::vector<std::string>
writePlaneFiles(const OutputFolder& out,
                const PlaneStepCloud& cloud,
                const PlaneStepResult& result,
                const PlaneStepOptions& options,
                const std::string& generator);

/** \return a table of the planes, for people: the largest 40 */
std::string
planeTable(const PlaneStepResult& result);

} // namespace pcl6d::app
