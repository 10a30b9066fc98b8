// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/plane_thickness.h>

namespace pcl6d {

/** \brief A plane within its hull, and which points belong to it. */
class PlanePatch {
public:
  /** \param[in] plane with a hull of at least 3 corners
   * \param[in] gate [m] \param[in] max_angle [rad] between normals */
  PlanePatch(const Plane& plane, double gate, double max_angle);

  /** \return the mean of the hull's corners [m] */
  const Eigen::Vector3d&
  centre() const
  {
    return centre_;
  }

  /** \return the signed distance to the plane [m] */
  double
  distanceOf(const Eigen::Vector3f& p) const
  {
    return normal_.dot(p.cast<double>()) - offset_;
  }

  /** \return whether a point lies over the hull, within the gate, and its normal looks
   * the way of the plane; one with a zero normal does not */
  bool
  holds(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /** \return the points that it holds, ascending */
  std::vector<std::size_t>
  membersOf(const MapPoints& map) const;

  /** \brief Lays the plane through points by least squares; the hull stays where it is. */
  void
  fit(const Points& points, const std::vector<std::size_t>& members);

  /** \return the plane, oriented by orientPlane(), its hull laid onto it */
  Plane
  plane() const;

private:
  Plane given_;
  double gate_;
  double min_cosine_;
  Eigen::Vector3d normal_;
  double offset_;
  Eigen::Vector3d centre_;
  double radius_ = 0;                   ///< [m] of the hull about its centre
  std::vector<Eigen::Vector3d> inward_; ///< per edge of the hull
};

} // namespace pcl6d
