// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scene_interpretation/scene_plane.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

/** \file Level planes seen from above. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \brief The hull of a level plane in plan, by half planes n.p <= d. */
class PlanHull {
public:
  explicit PlanHull(const ScenePlane& plane)
  {
    for (std::size_t i = 0; i < plane.corners.size(); ++i) {
      const Eigen::Vector2d from = plane.corners[i].head<2>();
      const Eigen::Vector2d edge =
          plane.corners[(i + 1) % plane.corners.size()].head<2>() - from;
      bounds_.extend(from);
      if (!(edge.norm() > 0))
        continue;
      const Eigen::Vector2d out = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
      // the centre decides the outer side
      const double sign = out.dot(plane.centre.head<2>() - from) > 0 ? -1 : 1;
      sides_.emplace_back(sign * out.x(), sign * out.y(), sign * out.dot(from));
    }
  }

  bool
  contains(const Eigen::Vector2d& point) const
  {
    return bounds_.contains(point) &&
           std::all_of(sides_.begin(), sides_.end(), [&](const Eigen::Vector3d& side) {
             return side.head<2>().dot(point) <= side.z();
           });
  }

private:
  std::vector<Eigen::Vector3d> sides_;
  Eigen::AlignedBox2d bounds_;
};

} // namespace pcl6d::semantic_map
