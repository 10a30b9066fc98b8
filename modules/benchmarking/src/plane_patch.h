// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/plane_thickness.h>

namespace pcl6d {

/** \brief A bounded plane, seen from one side, and which points belong to it. */
class PlanePatch {
public:
  /** \param[in] segment with a hull of at least 3 corners
   * \param[in] gate [m] \param[in] max_angle [rad] between normals */
  PlanePatch(const PlaneSegment& segment, double gate, double max_angle);

  /** \return the signed distance to the plane [m] */
  double
  distanceOf(const Eigen::Vector3f& p) const
  {
    return normal_.dot(p.cast<double>()) - offset_;
  }

  /** \return whether the middle of another patch lies within the hull and the gate, and
   * both look the same way */
  bool
  covers(const PlanePatch& other) const;

  /** \return the points over the outline, within the gate, whose normals look the way of
   * the patch; ascending */
  std::vector<std::size_t>
  membersOf(const MapPoints& map) const;

  /** \brief Lays the plane through points by least squares; hull and outline stay. */
  void
  fit(const Points& points, const std::vector<std::size_t>& members);

  /** \return the plane, oriented by orientPlane(), its hull laid onto it */
  Plane
  plane() const;

private:
  using Ring = std::vector<Eigen::Vector2d>;
  using Rings = std::vector<Ring>;

  Eigen::Vector2d
  onPlane(const Eigen::Vector3d& p) const
  {
    return axes_ * (p - centre_);
  }
  bool
  isNear(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  Plane given_;
  double gate_;
  double min_cosine_;
  Eigen::Vector3d normal_; ///< to where it was seen from
  double offset_;
  Eigen::Vector3d centre_;           ///< mean of the hull's corners [m]
  double radius_ = 0;                ///< [m] of the hull about its centre
  Eigen::Matrix<double, 2, 3> axes_; ///< of the plane as given
  Rings hull_;                       ///< one ring
  Rings outline_;                    ///< outer rings and holes
};

} // namespace pcl6d
