// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/object_localization/oriented_points.h>

namespace pcl6d {

namespace {
struct Sums {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::size_t count = 0;

  void
  add(const Eigen::Vector3f& p, const Eigen::Vector3f& n)
  {
    point += p.cast<double>();
    normal += n.cast<double>();
    ++count;
  }
};

/** The sums of the face with more points: normals on the side of the first, or not. */
Sums
largerFace(const OrientedPoints& surface, const IndexRange& members)
{
  Sums faces[2];
  const Eigen::Vector3f* first = nullptr;
  for (const auto index : members) {
    const auto i = static_cast<std::size_t>(index);
    const Eigen::Vector3f& normal = surface.normals[i];
    if (!(normal.squaredNorm() > 0.5F))
      continue;
    if (!first)
      first = &normal;
    faces[normal.dot(*first) < 0 ? 1 : 0].add(surface.points[i], normal);
  }
  return faces[1].count > faces[0].count ? faces[1] : faces[0];
}
} // namespace

OrientedPoints
reduceOriented(const OrientedPoints& surface, double voxel)
{
  if (surface.normals.size() != surface.points.size())
    throw BadArgument(std::to_string(surface.normals.size()) + " normals for " +
                      std::to_string(surface.points.size()) + " points");
  const VoxelGroups groups(surface.points, voxel);
  OrientedPoints reduced;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Sums face = largerFace(surface, groups.indices(g));
    if (face.count == 0)
      continue;
    reduced.points.push_back(
        (face.point / static_cast<double>(face.count)).cast<float>());
    reduced.normals.push_back(face.normal.normalized().cast<float>());
  }
  return reduced;
}

} // namespace pcl6d
