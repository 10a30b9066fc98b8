// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A cell of the plan with upright surfaces. */
struct PlanCell {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< [m] mean of its points
  Eigen::Vector2d facing = Eigen::Vector2d::Zero(); ///< unit vector across the surface
};

/** \brief The upright surfaces of a scan from above, about its origin. Two surfaces in a cell
 * with different normals fill two cells. */
struct Plan {
  double cell = 0; ///< [m] edge
  std::vector<PlanCell> cells;
};

/** \return [m] edge of the cells of a plan: a few voxels, enlarged until few enough cells are
 * filled and most of the scan fits into the table of votes */
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

/** \brief A motion in the plane that aligns cells of two plans. */
struct PlanPlacement {
  double yaw = 0;                                  ///< [rad]
  Eigen::Vector2d shift = Eigen::Vector2d::Zero(); ///< [m]
  double votes = 0; ///< pairs of cells, in standard deviations above the surroundings
};

/** \brief Resolution and extent of the search over plans. */
struct PlanSearch {
  int turns = 180; ///< tested headings per full turn
  int reach = 64;  ///< [cells] farther cells are skipped
};

/** \brief Correlates two plans: for each turn, every pair of cells with similar normals votes
 * for a shift.
 * \param[in] fixed, moved with equal edges of cells
 * \param[in] most largest number of placements, a few cells or turns apart
 * \return the best first; ties by yaw and shift
 * \note Source: share/doc/place_recognition.md, Plan and votes (a correlation of images by sparse
 * votes: whole numbers, equal on every platform) */
std::vector<PlanPlacement>
placePlan(const Plan& fixed,
          const Plan& moved,
          std::size_t most,
          const PlanSearch& search = {});

} // namespace pcl6d::global_registration
