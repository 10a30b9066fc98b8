// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coarse/feature_scan.h"

#include <pcl6d/visibility/ray_image.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl6d::registration {

/** \brief A scan, and its rays. */
struct PlacedScan {
  FeatureScan scan;
  RayImage rays;
};

/** \brief What a placement explains of one scan by the other. */
struct Support {
  std::size_t points = 0;
  std::size_t met = 0;          ///< a point of the other scan, with a like normal
  std::size_t contradicted = 0; ///< where the other scan looked through
};

/** \brief What a placement explains of both. */
struct PlacementSupport {
  Support source, target;

  /** \return the larger of both scans' shares of points that are met, in [0, 1]: a
   * scan may see much more than the other */
  double
  overlap() const;

  /** \return met of met and contradicted points of both scans, in [0, 1] */
  double
  consistency() const;

  /** \return overlap times consistency, by which placements are compared */
  double
  value() const;
};

/** \param[in] distance [m] within which a point is met
 * \param[in] step looks at each step-th point only, >= 1 */
PlacementSupport
supportOf(const PlacedScan& target,
          const PlacedScan& source,
          const Eigen::Isometry3d& T_target_source,
          double distance,
          std::size_t step);

/** \brief The placements beside one that its surfaces can tell least from it: moved by
 * about the same way to and fro along the three weakest of the six directions of the
 * point-to-plane problem. A corridor yields a slide along it, a plane its slides.
 * \param[in] distance [m] within which points hold each other
 * \param[in] way [m] of the points, root mean square
 * \return six placements; none if fewer than 6 points are held */
std::vector<Eigen::Isometry3d>
looselyHeld(const PlacedScan& target,
            const PlacedScan& source,
            const Eigen::Isometry3d& T_target_source,
            double distance,
            double way);

} // namespace pcl6d::registration
