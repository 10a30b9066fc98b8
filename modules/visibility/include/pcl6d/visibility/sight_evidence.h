// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visibility/ray_image.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Covariance of a small motion of points: of the velocity of the origin, then of the
 * rotation [m, rad], in the order of Twist. */
using MotionCovariance = Eigen::Matrix<double, 6, 6>;

/** \brief Uncertainty of the positions of points in the frame of the rays. */
struct PlaceUncertainty {
  double noise = 0; ///< [m] standard deviation of a point
  /** of the pose of the points, as motion about the origin of the rays' frame */
  MotionCovariance motion = MotionCovariance::Zero();
};

/** \brief Results of testing the points of a scan with the rays of another scan. Neighbouring
 * points are not independent, and are therefore also counted by patches of surface (cubes). */
struct SightEvidence {
  std::size_t confirmed = 0; ///< points
  std::size_t free = 0;      ///< points contradicted by rays
  std::size_t behind = 0;
  std::size_t edge = 0;
  std::size_t unseen = 0;
  std::size_t patches = 0;              ///< with at least 4 conclusive points
  std::size_t confirmed_patches = 0;    ///< with a majority of confirmed points
  std::size_t contradicted_patches = 0; ///< with at least 3 free points, and at least
                                        ///< half of the points free
  std::size_t things = 0; ///< contradicted isolated objects (SightPatch::largest_thing)
  std::size_t patches_of_things = 0; ///< contradicted patches of isolated objects

  /** \brief Adds the results of further points, e.g. of the opposite direction. */
  SightEvidence&
  operator+=(const SightEvidence& other);

  /** \return the number of tested points */
  std::size_t
  points() const
  {
    return confirmed + free + behind + edge + unseen;
  }
  /** \return free as share of free and confirmed; 0 without either */
  double
  contradiction() const;
  /** \return confirmed as share of all points; 0 without points */
  double
  confirmation() const;
};

/** \brief Grouping of neighbouring points. */
struct SightPatch {
  // Not explicit: an edge alone is a size.
  SightPatch(double edge_of_cube) : edge(edge_of_cube) {}
  SightPatch(double edge_of_cube, double largest)
  : edge(edge_of_cube), largest_thing(largest)
  {}

  double edge; ///< [m] of a cube of points; finite, > 0
  /** [m] largest diagonal of the bounding box of an isolated object: contradicted points at most
   * half a cube apart, or in one patch, with fewer than half of the conclusive points around
   * confirmed. Examples are a dynamic object, a piece of furniture at a wrong pose, and a part of
   * a wall seen through a gap. Finite, >= 0; 0: isolated objects are not counted */
  double largest_thing = 0;
};

/** \brief A contradicted point, for display. */
struct Contradiction {
  Eigen::Vector3f place = Eigen::Vector3f::Zero(); ///< [m] in the frame of the points
  float beyond = 0;   ///< [m] from the point to the end of the ray behind it
  bool clear = false; ///< in a contradicted patch
};

/** \brief Points of a scan to be tested, with the normals of their surfaces. Keeps references. */
struct TestedSurface {
  explicit TestedSurface(const Points& tested) : points(tested) {}
  TestedSurface(const Points& tested, const std::vector<Eigen::Vector3f>& of_points)
  : points(tested), normals(&of_points)
  {}

  const Points& points; ///< [m] in the scan's frame
  /** one per point, of length 1; zero: not known; null: none is known */
  const std::vector<Eigen::Vector3f>* normals = nullptr;
};

/** \brief Whether a ray that ended behind a point passed through the surface of the point, rather
 * than along it: at a grazing angle a ray that misses the point by the width of a cell ends on the
 * same surface, far behind. The distance across the surface must exceed the tolerance of the
 * image.
 * \param[in] seen the answer kFree of the image
 * \param[in] normal of the surface at the point, in the image's frame; zero: not known
 * \param[in] ray from the image's origin to the point */
bool
passedThrough(const SightOfPlace& seen,
              const Eigen::Vector3f& normal,
              const Eigen::Vector3f& ray);

/** \brief Tests the points of one scan with the ray image of another.
 *
 * Points with a normal are contradicted by rays that passed through their surface
 * (passedThrough()); if rays passed along it, the result is inconclusive, and counted as edge.
 * \param[in] T_image_points pose of the points' scan seen from the image's scan
 * \param[in] patch grouping of the points
 * \param[out] contradictions if given, the contradicted points are appended
 * \throws BadArgument patch is invalid, normals are not one per point, or a point is too far away
 * for the edge of the patch (see voxelKey()) */
SightEvidence
sightEvidence(const RayImage& image,
              const TestedSurface& surface,
              const Eigen::Isometry3d& T_image_points,
              const PlaceUncertainty& uncertainty,
              const SightPatch& patch,
              std::vector<Contradiction>* contradictions = nullptr);

/** \overload of points whose surfaces have unknown directions */
SightEvidence
sightEvidence(const RayImage& image,
              const Points& points,
              const Eigen::Isometry3d& T_image_points,
              const PlaceUncertainty& uncertainty,
              const SightPatch& patch,
              std::vector<Contradiction>* contradictions = nullptr);

/** \brief The share of a scan's own points contradicted by its rays: every second finite point is
 * tested in the image of the remaining points. Rays contradict dynamic points, and points apart
 * from all surfaces (rain, dust, sparse leaves). Points measured from another origin are rarely
 * contradicted at a right pose: points hidden from this origin lie behind a measured surface.
 * \return the share of contradicted points, as SightEvidence::contradiction()
 * \param[in] origin [m] of the rays */
double
selfContradiction(const Points& measured, const Eigen::Vector3f& origin, double noise);

} // namespace pcl6d
