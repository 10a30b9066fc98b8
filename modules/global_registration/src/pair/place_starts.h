// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "plan/floors.h"
#include "plan/plan.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A relative pose of two scans before matching. */
struct PlaceStart {
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double score = 0;          ///< in [0, 1], ranks the starts
  std::size_t placement = 0; ///< rank of its placement of the plans, by votes
};

/** The best start of each of the first placements is kept, whatever its score. In a mine
 * verticals are off by 3 to 6 deg, and rays contradict each pose before matching, but the
 * plans still agree. There half of the right starts are kept for their placement alone,
 * without a good score. */
constexpr std::size_t kTrustedPlacements = 20;

/** \brief Sorts by score, the best first; stable. */
void
sortByScore(std::vector<PlaceStart>& starts);

/** \brief A scan turned upright, and drawn. */
struct UprightScan {
  const PlaceableScan* scan;
  Eigen::Matrix3d R_level_scan;
  Plan plan;
  Floors floors;

  /** \param[in] up of the scan, unit vector \param[in] cell [m] of the plan */
  UprightScan(const PlaceableScan& placeable, const Eigen::Vector3d& up, double cell);
};

/** \brief Correlates the plans, adds heights, and scores the resulting poses.
 * \param[in] placements number of placements of the plans to score
 * \param[in] every scores use each n-th point
 * \return the best first; includes the best start of each placement with most votes */
std::vector<PlaceStart>
placeStarts(const UprightScan& first,
            const UprightScan& second,
            std::size_t placements,
            unsigned int num_threads,
            const PlanSearch& search = {},
            std::size_t every = 1);

} // namespace pcl6d::global_registration
