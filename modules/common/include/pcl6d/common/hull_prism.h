// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The space over and under the convex hull of a plane, without end.
 * \ingroup common */
class HullPrism {
public:
  /** \param[in] plane without corners its prism is all of space */
  explicit HullPrism(const Plane& plane)
  {
    for (std::size_t i = 0; i < plane.hull.size(); ++i) {
      const Eigen::Vector3d& corner = plane.hull[i];
      const Eigen::Vector3d edge = plane.hull[(i + 1) % plane.hull.size()] - corner;
      const Eigen::Vector3d out = edge.cross(plane.normal);
      if (out.norm() > 0)
        sides_.emplace_back() << out.normalized(), -out.normalized().dot(corner);
    }
  }

  /** \return whether a point is in the prism grown by a margin [m] */
  bool
  covers(const Eigen::Vector3d& point, double margin = 0) const
  {
    const Eigen::Vector4d place = point.homogeneous();
    return std::all_of(sides_.begin(), sides_.end(), [&](const Eigen::Vector4d& side) {
      return side.dot(place) <= margin;
    });
  }

private:
  std::vector<Eigen::Vector4d> sides_; // unit normal outwards n and -d, outside n.p > d
};

} // namespace pcl6d
