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

/** \brief Support of a placement by the points of one scan in the other. */
struct Support {
  std::size_t points = 0;
  std::size_t met = 0;          ///< points with a partner of like normal in
                                ///< the other scan
  std::size_t contradicted = 0; ///< points in the measured free space of the other scan
};

/** \brief Support of a placement by both scans. */
struct PlacementSupport {
  Support source, target;

  /** \return the larger of both scans' shares of points with a partner, in [0, 1]: a
   * scan may cover much more than the other */
  double
  overlap() const;

  /** \return met / (met + contradicted) points of both scans, in [0, 1] */
  double
  consistency() const;

  /** \return overlap times consistency, by which placements are compared */
  double
  value() const;
};

/** \param[in] distance [m] largest distance of a partner
 * \param[in] step looks at each step-th point only, >= 1 */
PlacementSupport
supportOf(const PlacedScan& target,
          const PlacedScan& source,
          const Eigen::Isometry3d& T_target_source,
          double distance,
          std::size_t step);

/** \brief The neighbouring placements least distinguishable by surfaces: moved by
 * about equal ways to and fro along the three weakest of the six directions of
 * the point-to-plane problem. A corridor yields a slide along the corridor, a
 * plane its slides.
 * \param[in] distance [m] largest distance of a partner
 * \param[in] way [m] of the points, root mean square
 * \return six placements; empty if fewer than 6 points have a partner */
std::vector<Eigen::Isometry3d>
looselyHeld(const PlacedScan& target,
            const PlacedScan& source,
            const Eigen::Isometry3d& T_target_source,
            double distance,
            double way);

} // namespace pcl6d::registration
