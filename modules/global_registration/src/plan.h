// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A place of the plan that upright surfaces fill. */
struct PlanCell {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< [m] mean of its points
  Eigen::Vector2d facing = Eigen::Vector2d::Zero(); ///< unit vector across the surface
};

/** \brief The upright surfaces of a scan from above, about its origin. Two surfaces in one
 * place that face differently fill two cells. */
struct Plan {
  double cell = 0; ///< [m] edge
  std::vector<PlanCell> cells;
};

/** \return [m] edge of the cells of a plan: a few voxels, and as many more as it takes so that
 * few enough cells are filled and that most of the scan fits into the table of votes */
double
planCell(const Points& points,
         const Normals& normals,
         const Eigen::Matrix3d& R_level_scan,
         double voxel);

Plan
drawPlan(const Points& points,
         const Normals& normals,
         const Eigen::Matrix3d& R_level_scan,
         double cell);

/** \brief A motion in the plane that brings cells of two plans together. */
struct PlanPlacement {
  double yaw = 0;                                  ///< [rad]
  Eigen::Vector2d shift = Eigen::Vector2d::Zero(); ///< [m]
  double votes = 0; ///< pairs of cells, in standard deviations above what is around
};

/** \brief How finely plans are laid over each other. */
struct PlanSearch {
  int turns = 180; ///< of a whole one that are tried
  int reach = 64;  ///< [cells] what lies farther from the scanner takes no part
};

/** \brief Tries all turns, and lets each pair of cells that then face alike vote for a shift.
 * \param[in] fixed, moved with the same edge of cells
 * \param[in] most so many placements, each a few cells or turns from the others
 * \return the best first; ties by yaw and shift
 * \note Source: algorithms.md G.1 (correlation of images, here by sparse votes, which are
 * whole numbers and so the same everywhere) */
std::vector<PlanPlacement>
placePlan(const Plan& fixed,
          const Plan& moved,
          std::size_t most,
          const PlanSearch& search = {});

} // namespace pcl6d::global_registration
