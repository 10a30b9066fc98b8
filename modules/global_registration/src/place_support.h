// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

namespace pcl6d::global_registration {

/** \brief What two scans say for and against a place, by few of their points: quick, for
 * ranking many. Of each kind of surface, level ones and others: everybody has a floor. */
struct PlaceSupport {
  struct Count {
    double points = 0;
    double met = 0;  ///< a surface of the other scan is there, and faces alike
    double free = 0; ///< the other scan looked through there
  };
  Count level, other;

  /** \return share of the points that meet the other scan, in [0, 1]: of other surfaces it
   * counts 0.7, of level ones 0.3 (algorithms.md G.4) */
  double
  overlap() const;

  /** \return free, as share of free and met, in [0, 1] */
  double
  contradiction() const;

  /** \return overlap exp(-contradiction / scale), in [0, 1] */
  double
  score(double scale) const;
};

/** \param[in] distance [m] within which a point meets a surface
 * \param[in] sigma [m] standard deviation of the place */
PlaceSupport
supportOf(const PlaceableScan& first,
          const PlaceableScan& second,
          const Eigen::Isometry3d& T_first_second,
          double distance,
          double sigma);

} // namespace pcl6d::global_registration
