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
  Plane plane;                       ///< least-squares fit; hull: the convex one
  std::vector<std::uint32_t> points; ///< places in the cloud, ascending

  /** \brief Which side was seen: `plane.normal` or its opposite, so that it points from
   * the surface to the sensor (to most of the sensors' places). The normal itself is
   * turned by the rule `offset >= 0` alone, which tells nothing about the side. */
  Eigen::Vector3d seen_from = Eigen::Vector3d::UnitZ();

  /** [m] The concave hull: rings of corners on the plane, the outer one first,
   * counter-clockwise as seen from where the normal points to, then its holes,
   * clockwise. A surface of several parts that lie close together has several outer
   * rings, each followed by its holes. Plane::area is the area inside. */
  std::vector<std::vector<Eigen::Vector3d>> outline;
};

/** \brief What a segmentation finds in a cloud. */
struct PlaneSegments {
  std::vector<PlaneSegment> planes;      ///< largest area first
  std::vector<std::uint32_t> unassigned; ///< points on no plane, ascending
};

} // namespace pcl6d
