// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

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

  /** \return points that met */
  double
  met() const
  {
    return level.met + other.met;
  }

  /** \brief Adds those of other scans. */
  PlaceSupport&
  operator+=(const PlaceSupport& more);

  /** \return free, as share of free and met, in [0, 1] */
  double
  contradiction() const;

  /** \return overlap exp(-contradiction / scale), in [0, 1] */
  double
  score(double scale) const;
};

/** \brief What became of a point of one scan at another. */
enum class PointSight : std::uint8_t { kNotAsked, kNothing, kMet, kFree };

/** \brief Adds how points of a scan count, each as what became of it.
 * \param[in] sights one per judged point of the scan */
void
count(const PlaceableScan& of,
      const std::vector<PointSight>& sights,
      PlaceSupport& support);

/** \return what becomes of the judged points of a scan at the surfaces and in the rays of
 * another. \param[in] distance, sigma, every as supportOf() */
std::vector<PointSight>
lookAt(const PlaceableScan& at,
       const PlaceableScan& of,
       const Eigen::Isometry3d& T_at_of,
       double distance,
       double sigma,
       std::size_t every = 1);

/** \param[in] distance [m] within which a point meets a surface
 * \param[in] sigma [m] standard deviation of the place
 * \param[in] every only each n-th judged point is asked */
PlaceSupport
supportOf(const PlaceableScan& first,
          const PlaceableScan& second,
          const Eigen::Isometry3d& T_first_second,
          double distance,
          double sigma,
          std::size_t every = 1);

} // namespace pcl6d::global_registration
