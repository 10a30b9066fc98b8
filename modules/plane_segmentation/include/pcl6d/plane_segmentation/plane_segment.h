// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <cstdint>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A plane found in a cloud: one connected surface and the points on it.
 * \ingroup plane_segmentation */
struct PlaneSegment {
  Plane plane;                       ///< least-squares fit; hull: the convex hull
  std::vector<std::uint32_t> points; ///< indices into the cloud, ascending

  /** \brief Side of the surface that faces the sensor (most of the sensor positions):
   * `plane.normal` or its opposite. The sign of the normal itself follows from `offset
   * >= 0` alone. */
  Eigen::Vector3d seen_from = Eigen::Vector3d::UnitZ();

  /** [m] The concave hull: rings of corners on the plane. The outer ring comes first,
   * counter-clockwise with the normal towards the viewer, then its holes, clockwise. A
   * surface of several close parts has several outer rings, each followed by its holes.
   * Plane::area is the area inside. */
  std::vector<std::vector<Eigen::Vector3d>> outline;
};

/** \brief Result of a segmentation. */
struct PlaneSegments {
  std::vector<PlaneSegment> planes;      ///< largest area first
  std::vector<std::uint32_t> unassigned; ///< points on no plane, ascending
};

} // namespace pcl6d
