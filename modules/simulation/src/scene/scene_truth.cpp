// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/simulation/scene_truth.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace {
constexpr double kFlat = 1e-6;  // [m] largest distance from the plane
constexpr double kTouch = 1e-3; // [m] between boxes of touching surfaces

// The flat part of a scene covered by a surface or plane.
struct Patch {
  Eigen::Vector3d normal;
  double offset = 0;
  double area = 0;
  Eigen::AlignedBox3d box;
  bool is_flat = true;
  PlaneLabel label = PlaneLabel::kNone;
  std::uint32_t object = 0;
};

Eigen::Vector3d
areaVector(const TriangleScene& scene, std::size_t triangle)
{
  const auto index = static_cast<std::uint32_t>(triangle);
  const Eigen::Vector3d& a = scene.corner(index, 0);
  return (scene.corner(index, 1) - a).cross(scene.corner(index, 2) - a) / 2;
}

// Per surface; the normal is taken from its largest triangle.
std::vector<Patch>
surfacePatches(const TriangleScene& scene)
{
  std::vector<Patch> patches(scene.surfaces.size());
  std::vector<double> largest(patches.size(), 0);
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const std::uint32_t surface = scene.triangles[i].surface;
    Patch& patch = patches[surface];
    const Eigen::Vector3d vector = areaVector(scene, i);
    const double area = vector.norm();
    patch.area += area;
    for (int corner = 0; corner < 3; ++corner)
      patch.box.extend(scene.corner(static_cast<std::uint32_t>(i), corner));
    if (area <= largest[surface])
      continue;
    largest[surface] = area;
    patch.normal = vector / area;
    patch.offset = patch.normal.dot(scene.corner(static_cast<std::uint32_t>(i), 0));
  }
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    Patch& patch = patches[scene.triangles[i].surface];
    for (int corner = 0; corner < 3; ++corner) {
      const auto& p = scene.corner(static_cast<std::uint32_t>(i), corner);
      if (std::abs(patch.normal.dot(p) - patch.offset) > kFlat)
        patch.is_flat = false;
    }
    if (areaVector(scene, i).dot(patch.normal) < 0) // a folded sheet
      patch.is_flat = false;
  }
  return patches;
}

PlaneLabel
labelOf(PlaneLabel wanted, const Eigen::Vector3d& normal)
{
  const SinCos tolerance = portableSinCos(10 * M_PI / 180);
  bool fits = false;
  switch (wanted) {
  case PlaneLabel::kFloor:
    fits = normal.z() > tolerance.cos;
    break;
  case PlaneLabel::kCeiling:
    fits = normal.z() < -tolerance.cos;
    break;
  case PlaneLabel::kWall:
  case PlaneLabel::kDoor:
    fits = std::abs(normal.z()) < tolerance.sin;
    break;
  case PlaneLabel::kNone:
    break;
  }
  return fits ? wanted : PlaneLabel::kNone;
}

bool
belongTogether(const Patch& a, const Patch& b)
{
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kTouch);
  return a.label == b.label && a.object == b.object &&
         (a.normal - b.normal).norm() < 1e-6 && std::abs(a.offset - b.offset) < kFlat &&
         Eigen::AlignedBox3d(a.box.min() - reach, a.box.max() + reach)
             .intersects(b.box);
}

// Groups patches into planes: for each patch the index of the first patch of its group.
std::vector<std::size_t>
groupPatches(const std::vector<Patch>& patches, const std::vector<bool>& counts)
{
  std::vector<std::size_t> root(patches.size());
  const auto rootOf = [&](std::size_t i) {
    while (root[i] != i)
      i = root[i];
    return i;
  };
  for (std::size_t i = 0; i < patches.size(); ++i) {
    root[i] = i;
    for (std::size_t k = 0; counts[i] && k < i; ++k)
      if (counts[k] && belongTogether(patches[i], patches[k])) {
        const std::size_t a = rootOf(i);
        const std::size_t b = rootOf(k);
        root[std::max(a, b)] = std::min(a, b);
      }
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
    root[i] = rootOf(i);
  return root;
}
} // namespace

void
numberPlanes(TriangleScene& scene, double min_area)
{
  std::vector<Patch> patches = surfacePatches(scene);
  std::vector<bool> counts(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    counts[i] = patches[i].is_flat && patches[i].area >= min_area;
    patches[i].object = scene.surfaces[i].object;
    patches[i].label = counts[i] ? labelOf(scene.surfaces[i].label, patches[i].normal)
                                 : PlaneLabel::kNone;
  }
  const std::vector<std::size_t> group = groupPatches(patches, counts);
  std::uint32_t num_planes = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Surface& surface = scene.surfaces[i];
    surface.label = patches[i].label;
    surface.plane = 0;
    if (counts[i])
      surface.plane = group[i] == i ? ++num_planes : scene.surfaces[group[i]].plane;
  }
}

std::vector<Plane>
scenePlanes(const TriangleScene& scene, const Eigen::Isometry3d& T_scene_world)
{
  const Eigen::Isometry3d T_world_scene = T_scene_world.inverse();
  std::vector<Plane> planes;
  std::vector<std::vector<Eigen::Vector3d>> corners;
  std::vector<double> largest;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const Surface& surface = scene.surfaces[scene.triangles[i].surface];
    if (surface.plane == 0)
      continue;
    const std::size_t k = surface.plane - 1;
    if (k >= planes.size()) {
      planes.resize(k + 1);
      corners.resize(k + 1);
      largest.resize(k + 1, 0);
    }
    const Eigen::Vector3d vector = areaVector(scene, i);
    const double area = vector.norm();
    planes[k].area += area;
    for (int corner = 0; corner < 3; ++corner)
      corners[k].push_back(T_world_scene *
                           scene.corner(static_cast<std::uint32_t>(i), corner));
    if (area <= largest[k])
      continue;
    largest[k] = area;
    planes[k].label = toString(surface.label);
    planes[k].normal = T_world_scene.linear() * (vector / area);
    planes[k].offset = planes[k].normal.dot(corners[k].back());
  }
  for (std::size_t k = 0; k < planes.size(); ++k) {
    planes[k].hull = convexHull(corners[k], planes[k].normal);
    orientPlane(planes[k]);
  }
  return planes;
}

} // namespace pcl6d
