// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/doctor_cloud.h"
#include "doctor/doctor_settings.h"

#include <pcl6d/search/point_tree.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief Position of a scanner, in the coordinates of its cloud. */
struct ScannerPlace {
  Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< [m]
  std::string why;                                 ///< "0 of its coordinates"
  bool known = true;                               ///< false: the position is a guess
};

/** \brief Measures of the finite, selected points of a cloud. */
struct CloudMeasures {
  std::size_t points = 0;     ///< finite and selected
  std::size_t not_finite = 0; ///< rows
  Eigen::AlignedBox3d box;    ///< [m] in full coordinates
  Eigen::Vector3d middle =
      Eigen::Vector3d::Zero();         ///< median of each, full coordinates
  double spread = 0;                   ///< [m] median distance from the middle
  double spacing = 0;                  ///< [m] median distance of neighbours
  double float_step = 0;               ///< [m] of the largest coordinate
  std::array<std::size_t, 3> values{}; ///< distinct values of x, y, z, as float
  std::size_t duplicates = 0;          ///< points with the coordinates of another point
  ScannerPlace scanner;
  std::optional<double> no_return; ///< [m] range used by the scanner for no echo
  std::size_t num_no_return = 0;   ///< points there
};

/** \brief How the source lies on the target at a pose. */
struct PoseFit {
  double share = 0;  ///< of the source's points: another within the limit
  double median = 0; ///< [m] distance to the nearest point of the target
  double misfit = 0; ///< [m] root of the mean square, no distance above the limit
};

/** \brief Both clouds, their measures, and settings derived from the measures. Poses are
 * T_target_source of the local coordinates (DoctorCloud::offset) unless said otherwise. */
struct DoctorPair {
  DoctorCloud source, target;
  CloudMeasures of_source, of_target;
  std::string guess_words;       ///< where the start comes from
  Eigen::Isometry3d guess_given; ///< in full coordinates
  Eigen::Isometry3d start;       ///< the same, local
  PoseFit at_start;
  double spacing = 0;      ///< [m] of the coarser cloud
  double max_distance = 0; ///< [m] limit of pairs; 0: no points
  std::string max_distance_why;
  double resolution = 0; ///< [m] of the cells of NDT
  double voxel = 0;      ///< [m] leaf of a reduction
  std::string voxel_why;
  double reach = 0; ///< [m] largest range of points that a reduction can process
  Points source_points, target_points; ///< local, finite, that count
  std::optional<PointTree> tree;       ///< of the target's

  bool
  canBeMatched() const
  {
    return of_source.points >= 3 && of_target.points >= 3;
  }

  /** \return [m] limit of pairs at a start: three spacings, or twice the median
   * distance if larger */
  double
  maxDistanceAt(const PoseFit& fit) const;

  /** \return the selected points, in the frame of their scanner */
  Points
  seen(const DoctorCloud& cloud) const;

  /** \return whether most points start farther from the target than the size of the target */
  bool
  startsApart() const
  {
    return at_start.median > 2 * of_target.spread;
  }

  /** \return whether float has no digits to spare where the clouds are */
  bool
  isFar() const
  {
    return !source.offset.isZero() || !target.offset.isZero();
  }

  Eigen::Isometry3d
  toLocal(const Eigen::Isometry3d& pose) const;
  Eigen::Isometry3d
  toFull(const Eigen::Isometry3d& pose) const;

  /** \return [m] least difference of poses that the points can distinguish */
  double
  tolerance() const;

  /** \brief The motion between poses, at the source: translation of its middle [m], rotation
   * [rad]. Shift [m] is the translation plus the rotation times the cloud's spread. */
  struct Difference {
    double translation = 0, rotation = 0, shift = 0;
  };
  Difference
  between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;

  PoseFit
  fitAt(const Eigen::Isometry3d& pose, double limit) const;
};

/** \brief Reads the input, and measures everything that needs no registration.
 * \throws IoFailed a file is missing or broken \throws UsageError no pose in --guess */
DoctorPair
loadPair(const DoctorSettings& settings);

} // namespace pcl6d::app
