// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visibility/ray_image.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Covariance of a small motion of points: of the velocity of the origin, then the
 * rotation [m, rad], as Twist orders them. */
using MotionCovariance = Eigen::Matrix<double, 6, 6>;

/** \brief How well the places of points are known in the frame of the rays. */
struct PlaceUncertainty {
  double noise = 0; ///< [m] standard deviation of a point
  /** of the pose of the points, as a motion about the origin of the rays' frame */
  MotionCovariance motion = MotionCovariance::Zero();
};

/** \brief What the rays of one scan say of the points of another. Points near each other
 * are not independent: so they are counted, too, by patches of surface (cubes). */
struct SightEvidence {
  std::size_t confirmed = 0; ///< points
  std::size_t free = 0;      ///< points that the rays contradict
  std::size_t behind = 0;
  std::size_t edge = 0;
  std::size_t unseen = 0;
  std::size_t patches = 0;              ///< with at least 4 points that say something
  std::size_t confirmed_patches = 0;    ///< most of whose points are confirmed
  std::size_t contradicted_patches = 0; ///< at least 3, and half of whose points, free
  std::size_t things =
      0; ///< contradicted ones that stand alone (SightPatch::largest_thing)
  std::size_t patches_of_things = 0; ///< of the contradicted patches, those of things

  /** \brief Adds what is known of other points, such as those of the other way round. */
  SightEvidence&
  operator+=(const SightEvidence& other);

  /** \return points looked at */
  std::size_t
  points() const
  {
    return confirmed + free + behind + edge + unseen;
  }
  /** \return free, as share of free and confirmed; 0 without either */
  double
  contradiction() const;
  /** \return confirmed, as share of all points; 0 without points */
  double
  confirmation() const;
};

/** \brief How points that are near each other count together. */
struct SightPatch {
  // Not explicit: an edge alone is a size.
  SightPatch(double edge_of_cube) : edge(edge_of_cube) {}
  SightPatch(double edge_of_cube, double largest)
  : edge(edge_of_cube), largest_thing(largest)
  {}

  double edge; ///< [m] of a cube of points; finite, > 0
  /** [m] diagonal of the box about the largest thing: contradicted points no farther apart than
   * half a cube, or in one patch, around which fewer than half of those that say something are
   * confirmed. Something that has walked on, or a piece of furniture at a wrong pose; a part of a
   * wall that is hidden but for a gap, too. Finite, >= 0; 0: things are not looked for */
  double largest_thing = 0;
};

/** \brief A contradicted point, for a picture of it. */
struct Contradiction {
  Eigen::Vector3f place = Eigen::Vector3f::Zero(); ///< [m] in the frame of the points
  float beyond = 0;   ///< [m] how far behind it the ray ended
  bool clear = false; ///< in a contradicted patch
};

/** \brief Looks at the points of one scan in the image of another.
 * \param[in] T_image_points pose of the points' scan seen from that of the image
 * \param[in] patch how they are counted
 * \param[out] contradictions if given, the contradicted points are added to it
 * \throws BadArgument patch breaks its rules, or a point is too far away for it (see
 * voxelKey()) */
SightEvidence
sightEvidence(const RayImage& image,
              const Points& points,
              const Eigen::Isometry3d& T_image_points,
              const PlaceUncertainty& uncertainty,
              const SightPatch& patch,
              std::vector<Contradiction>* contradictions = nullptr);

/** \brief How far the rays of a scan contradict its own points: every second finite point,
 * looked at in the image of the others. Points that move, or that stand apart from all
 * others (rain, dust, sparse leaves), do so. Points of another origin do hardly, if they
 * are where they belong: what is hidden from this origin lies behind something measured.
 * \return the share of contradicted points, as SightEvidence::contradiction()
 * \param[in] origin [m] of the rays */
double
selfContradiction(const Points& measured, const Eigen::Vector3f& origin, double noise);

} // namespace pcl6d
