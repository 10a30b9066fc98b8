// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Support of a relative pose by a few points of two scans: quick, for ranking many.
 * Counted apart for level and other surfaces, as every scan has a floor. */
struct PlaceSupport {
  struct Count {
    double points = 0;
    double met = 0;  ///< on a surface of the other scan with a similar normal
    double free = 0; ///< violations: passed by rays of the other scan
  };
  Count level, other;

  /** \return overlap: weighted share of points on surfaces of the other scan, in [0, 1]; weight
   * 0.3 for level surfaces, 0.7 for the rest (share/doc/place_recognition.md, Score) */
  double
  overlap() const;

  /** \return points that met */
  double
  met() const
  {
    return level.met + other.met;
  }

  /** \brief Adds the counts of further scans. */
  PlaceSupport&
  operator+=(const PlaceSupport& more);

  /** \return violations / (violations + met points), in [0, 1] */
  double
  contradiction() const;

  /** \return overlap exp(-contradiction / scale), in [0, 1] */
  double
  score(double scale) const;
};

/** \brief Result of testing a point of a scan by another scan. */
enum class PointSight : std::uint8_t { kNotAsked, kNothing, kMet, kFree };

/** \brief Adds the test points of a scan to the counts.
 * \param[in] sights result of each test point of the scan */
void
count(const PlaceableScan& of,
      const std::vector<PointSight>& sights,
      PlaceSupport& support);

/** \return the results of the test points of a scan at the surfaces and in the rays of another.
 * \param[in] distance, sigma, every as supportOf() */
std::vector<PointSight>
lookAt(const PlaceableScan& at,
       const PlaceableScan& of,
       const Eigen::Isometry3d& T_at_of,
       double distance,
       double sigma,
       std::size_t every = 1);

/** \param[in] distance [m] within which a point meets a surface
 * \param[in] sigma [m] standard deviation of the pose
 * \param[in] every only each n-th point is tested */
PlaceSupport
supportOf(const PlaceableScan& first,
          const PlaceableScan& second,
          const Eigen::Isometry3d& T_first_second,
          double distance,
          double sigma,
          std::size_t every = 1);

} // namespace pcl6d::global_registration
