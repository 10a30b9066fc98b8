// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/object_localization/oriented_points.h>

#include <array>

namespace pcl6d {

namespace {
/** A face with fewer points than the other face over this number is an edge or
 * noise. */
constexpr std::size_t kFaceShare = 3;

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

/** The sums of both faces: normals on the side of the first, or not. */
std::array<Sums, 2>
facesOf(const OrientedPoints& surface, const IndexRange& members)
{
  std::array<Sums, 2> faces;
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
  return faces;
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
    const auto faces = facesOf(surface, groups.indices(g));
    for (int f = 0; f < 2; ++f) {
      const auto& face = faces[f];
      if (face.count == 0 || kFaceShare * face.count < faces[1 - f].count)
        continue;
      reduced.points.push_back(
          (face.point / static_cast<double>(face.count)).cast<float>());
      reduced.normals.push_back(face.normal.normalized().cast<float>());
    }
  }
  return reduced;
}

} // namespace pcl6d
