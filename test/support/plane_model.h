// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/box_room.h"

#include <pcl6d/common/points.h>
#include <pcl6d/common/rotation.h>

namespace pcl6d::test {

/** \brief Planes and the points on them. */
struct PlaneModel {
  std::vector<PlaneSegment> planes;
  Points points;
};

/** \brief How a model differs from the truth. */
struct PlaneErrors {
  double noise = 0.01; // [m] of points
  double angle = 0;    // [rad] of planes, about each axis
};

/** \return 4000 points on each plane, all turned about its centre first */
inline PlaneModel
modelOf(const std::vector<TruePlane>& truth, const PlaneErrors& errors, Random& random)
{
  PlaneModel model;
  for (const auto& t : truth) {
    PlaneSegment segment;
    segment.plane = t.plane;
    segment.seen_from = t.seen_from;
    const auto& hull = t.plane.hull;
    const Eigen::Vector3d centre = (hull[0] + hull[2]) / 2;
    Eigen::Vector3d w(random.normal(), random.normal(), random.normal());
    const Eigen::Matrix3d R = pcl6d::rotationFromVector(errors.angle * w);
    for (int i = 0; i < 4000; ++i) {
      const double u = random.uniform(-1, 1), v = random.uniform(-1, 1);
      const Eigen::Vector3d p = u * (hull[1] - hull[0]) / 2 +
                                v * (hull[3] - hull[0]) / 2 +
                                errors.noise * random.normal() * t.plane.normal;
      segment.points.push_back(static_cast<std::uint32_t>(model.points.size()));
      model.points.push_back((centre + R * p).cast<float>());
    }
    segment.plane.normal = R * t.plane.normal;
    for (auto& corner : segment.plane.hull)
      corner = centre + R * (corner - centre);
    segment.plane.offset = segment.plane.normal.dot(centre);
    orientPlane(segment.plane);
    segment.outline = {segment.plane.hull};
    model.planes.push_back(segment);
  }
  return model;
}

} // namespace pcl6d::test
