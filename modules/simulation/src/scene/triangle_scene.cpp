// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

namespace pcl6d {
namespace {
// Twice the area, as a vector normal to the triangle.
Eigen::Vector3d
twiceArea(const TriangleScene& scene, std::uint32_t triangle)
{
  const Eigen::Vector3d& a = scene.corner(triangle, 0);
  return (scene.corner(triangle, 1) - a).cross(scene.corner(triangle, 2) - a);
}

void
validateTriangle(const TriangleScene& scene, std::uint32_t index)
{
  const std::string name = "triangle " + std::to_string(index) + ": ";
  const Triangle& triangle = scene.triangles[index];
  for (const auto vertex : triangle.vertices)
    if (vertex >= scene.vertices.size())
      throw BadArgument(name + "vertex " + std::to_string(vertex) + ", but there are " +
                        std::to_string(scene.vertices.size()));
  if (triangle.surface >= scene.surfaces.size())
    throw BadArgument(name + "surface " + std::to_string(triangle.surface) +
                      ", but there are " + std::to_string(scene.surfaces.size()));
  if (!(twiceArea(scene, index).squaredNorm() > 0))
    throw BadArgument(name + "area is zero, but must be > 0");
}

void
validateShare(const Surface& surface, const char* name, double share)
{
  if (!(share >= 0 && share <= 1))
    throw BadArgument("surface " + surface.name + ": " + name + " = " +
                      std::to_string(share) + ", but must be in [0, 1]");
}
} // namespace

std::uint32_t
TriangleScene::addSurface(const Surface& surface)
{
  surfaces.push_back(surface);
  return static_cast<std::uint32_t>(surfaces.size() - 1);
}

void
TriangleScene::addQuad(const std::array<std::uint32_t, 4>& corners,
                       std::uint32_t surface)
{
  triangles.push_back({{corners[0], corners[1], corners[2]}, surface});
  triangles.push_back({{corners[0], corners[2], corners[3]}, surface});
}

Eigen::Vector3d
TriangleScene::normal(std::uint32_t triangle) const
{
  return twiceArea(*this, triangle).normalized();
}

void
TriangleScene::validate() const
{
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!isPlace(vertices[i]))
      throw BadArgument("vertex " + std::to_string(i) +
                        (vertices[i].allFinite()
                             ? " is 1e9 m or farther from the origin"
                             : " is not finite"));
  for (const auto& surface : surfaces) {
    validateShare(surface, "reflectance", surface.reflectance);
    validateShare(surface, "transmittance", surface.transmittance);
  }
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    validateTriangle(*this, i);
}

} // namespace pcl6d
