// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/localisation/levelling.h>
#include <pcl6d/localisation/segment_cut.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
bool
isWall(const Plane& plane)
{
  return (plane.label == toString(PlaneLabel::kWall) ||
          plane.label == toString(PlaneLabel::kDoor)) &&
         plane.inliers > 0 && plane.hull.size() >= 3;
}

/** \return the hull of an upright plane from above: from one end to the other */
Segment
fromAbove(const Plane& plane, const Eigen::Matrix3d& R)
{
  const Eigen::Vector2d normal = (R * plane.normal).head<2>().normalized();
  const Eigen::Vector2d along(-normal.y(), normal.x());
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const auto& corner : plane.hull)
    centre += (R * corner).head<2>() / static_cast<double>(plane.hull.size());
  double low = 0, high = 0;
  for (const auto& corner : plane.hull) {
    const double s = along.dot((R * corner).head<2>() - centre);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return {centre + low * along, centre + high * along};
}
} // namespace

Segments
wallsOf(const std::vector<Plane>& planes,
        const Eigen::Matrix3d& R_level_world,
        double min_length)
{
  Segments walls;
  for (const auto& plane : planes) {
    if (!isWall(plane))
      continue;
    const Segment wall = fromAbove(plane, R_level_world);
    if ((wall.b - wall.a).norm() >= min_length)
      walls.push_back(wall);
  }
  return walls;
}

Eigen::Matrix3d
levelOfPlanes(const std::vector<Plane>& planes)
{
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> areas;
  for (const auto& plane : planes)
    if (isWall(plane)) {
      normals.push_back(plane.normal);
      areas.push_back(plane.area);
    }
  return levelByNormals(normals, areas).R_level_source;
}

Segments
sliceOf(const TriangleMesh& mesh, double height)
{
  Segments segments;
  for (const auto& triangle : mesh.triangles) {
    std::vector<Eigen::Vector2d> crossings;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& p = mesh.vertices[triangle[i]];
      const Eigen::Vector3d& q = mesh.vertices[triangle[(i + 1) % 3]];
      if ((p.z() < height) == (q.z() < height)) // a corner in the plane is above it
        continue;
      const double s = (height - p.z()) / (q.z() - p.z());
      crossings.push_back((p + s * (q - p)).head<2>());
    }
    if (crossings.size() == 2 && crossings[0] != crossings[1])
      segments.push_back({crossings[0], crossings[1]});
  }
  return segments;
}

} // namespace pcl6d
