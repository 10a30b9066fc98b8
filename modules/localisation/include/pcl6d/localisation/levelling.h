// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A levelling rotation, with its certainty. */
struct Levelling {
  Eigen::Matrix3d R_level_source =
      Eigen::Matrix3d::Identity(); ///< roll and pitch alone: turns the source upright
  double walls = 0;      ///< total weight of the normals used, in points or m^2
  bool is_fixed = false; ///< walls of two directions fix both roll and pitch
};

/** \brief Finds roll and pitch from walls, whose normals are horizontal: minimises sum w (n . up)^2
 * with robust weights against normals of other surfaces, starting from a guess.
 *
 * A direction faced by too few walls keeps its tilt. Slopes, leaves and furniture count little:
 * normals farther than 24 deg from horizontal are left out, and the limit then shrinks.
 * \param[in] normals unit vectors; zero vectors are skipped
 * \param[in] weights >= 0, one per normal, or empty for equal weights
 * \param[in] guess R_level_source, wrong by no more than about 10 deg
 * \param[in] least weight that must face a direction to fix its tilt
 * \throws BadArgument weights are not one per normal */
Levelling
levelByNormals(const std::vector<Eigen::Vector3d>& normals,
               const std::vector<double>& weights,
               const Eigen::Matrix3d& guess = Eigen::Matrix3d::Identity(),
               double least = 0);

/** \brief levelByNormals() of the surfaces in a scan. \param[in] points [m]
 * \param[in] voxel [m] of the reduction before normals are estimated; finite, > 0
 * \ingroup localisation */
Levelling
levelByWalls(const Points& points,
             const Eigen::Matrix3d& guess = Eigen::Matrix3d::Identity(),
             double voxel = 0.2);

/** \return the rotation, by roll and pitch alone, of `up` (a direction in the source) to z */
Eigen::Matrix3d
levellingOf(const Eigen::Vector3d& up);

} // namespace pcl6d
