// SPDX-License-Identifier: BSD-3-Clause
#include "scan_planes.h"

#include <pcl6d/plane_segmentation/segment_planes.h>

namespace pcl6d {

std::vector<Plane>
planesOfScan(const Points& points, const Eigen::Isometry3d& T_world_scan)
{
  std::vector<Plane> planes;
  for (PlaneSegment& segment : segmentPlanes(PlaneCloud(points, 1)).planes) {
    Plane plane = std::move(segment.plane);
    const double side = segment.seen_from.dot(plane.normal) < 0 ? -1 : 1;
    const Eigen::Vector3d on_plane = T_world_scan * (plane.offset * plane.normal);
    plane.normal = side * (T_world_scan.linear() * plane.normal);
    plane.offset = plane.normal.dot(on_plane);
    for (auto& corner : plane.hull)
      corner = T_world_scan * corner;
    planes.push_back(std::move(plane));
  }
  return planes;
}

} // namespace pcl6d
