// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "floors.h"
#include "plan.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A place of a scan on another, before it is matched. */
struct PlaceStart {
  Eigen::Isometry3d T_first_second = Eigen::Isometry3d::Identity();
  double score = 0; ///< in [0, 1], by which starts are ranked
  std::size_t placement =
      0; ///< of the plans, from the best on: how often they voted for it
};

/** The best start of so many placements is kept, however it is judged: in a mine verticals are
 * off by 3 to 6 deg, rays deny each place until it is matched, but the plans still agree. Half
 * of the right ones are among so many there that are not among those with a good score. */
constexpr std::size_t kTrustedPlacements = 20;

/** \brief Sorts by score, the best first; equal ones stay in order. */
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

/** \brief Lays the plans over each other, adds heights, and looks at what comes out.
 * \param[in] placements so many of the plans are looked at
 * \param[in] every they are judged by each n-th point
 * \return the best first; of the placements with most votes the best start in any case */
std::vector<PlaceStart>
placeStarts(const UprightScan& first,
            const UprightScan& second,
            std::size_t placements,
            unsigned int num_threads,
            const PlanSearch& search = {},
            std::size_t every = 1);

} // namespace pcl6d::global_registration
