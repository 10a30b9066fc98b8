// SPDX-License-Identifier: BSD-3-Clause
#include "scan_planes.h"

#include <pcl6d/plane_segmentation/segment_planes.h>

namespace pcl6d {

std::vector<PlaneSegment>
planesOfScan(const Points& points, const Eigen::Isometry3d& T_world_scan)
{
  std::vector<PlaneSegment> segments = segmentPlanes(PlaneCloud(points, 1)).planes;
  for (PlaneSegment& segment : segments) {
    Plane& plane = segment.plane;
    const Eigen::Vector3d on_plane = T_world_scan * (plane.offset * plane.normal);
    plane.normal = T_world_scan.linear() * plane.normal;
    plane.offset = plane.normal.dot(on_plane);
    segment.seen_from = T_world_scan.linear() * segment.seen_from;
    for (auto& corner : plane.hull)
      corner = T_world_scan * corner;
    for (auto& ring : segment.outline)
      for (auto& corner : ring)
        corner = T_world_scan * corner;
    segment.points.clear(); // places in a scan say nothing of the map
  }
  return segments;
}

} // namespace pcl6d
