// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>

#include <cmath>

namespace pcl6d {
namespace {
void
validate(const Revolved& body)
{
  require(body.foot.allFinite(), "foot of a body", body.foot.transpose(), "finite");
  require(body.segments >= 3 && body.segments <= 10000,
          "segments of a body",
          body.segments,
          "in [3, 10000]");
  require(body.profile.size() >= 2, "profile's length", body.profile.size(), ">= 2");
  for (std::size_t i = 0; i < body.profile.size(); ++i) {
    const Eigen::Vector2d& point = body.profile[i];
    require(point.x() > 0 && std::isfinite(point.x()), "radius", point.x(), "> 0");
    require(i == 0 || point.y() > body.profile[i - 1].y(),
            "height in a profile",
            point.y(),
            "above the one before");
  }
}

// A fan around the middle of a lid. \param[in] ring its first vertex on the rim
void
addLid(TriangleScene& scene,
       std::uint32_t ring,
       std::uint32_t count,
       bool is_upper,
       const Surface& material)
{
  const std::uint32_t surface = scene.addSurface(material);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::uint32_t i = 0; i < count; ++i)
    middle += scene.vertices[ring + i] / count;
  middle.z() = scene.vertices[ring].z(); // exactly flat
  const auto centre = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.push_back(middle);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = ring + i;
    const std::uint32_t b = ring + (i + 1) % count;
    scene.triangles.push_back({{centre, is_upper ? a : b, is_upper ? b : a}, surface});
  }
}
} // namespace

void
addRevolved(TriangleScene& scene, const Revolved& body, const Surface& material)
{
  validate(body);
  const auto count = static_cast<std::uint32_t>(body.segments);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  for (const auto& point : body.profile)
    for (int i = 0; i < body.segments; ++i) {
      const SinCos turn = portableSinCos(2 * M_PI * i / body.segments);
      scene.vertices.emplace_back(body.foot + Eigen::Vector3d(point.x() * turn.cos,
                                                              point.x() * turn.sin,
                                                              point.y()));
    }
  const std::uint32_t shell = scene.addSurface(material);
  const auto rings = static_cast<std::uint32_t>(body.profile.size());
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t low = first + ring * count;
      const std::uint32_t next = (i + 1) % count;
      scene.addQuad({low + i, low + next, low + count + next, low + count + i}, shell);
    }
  addLid(scene, first, count, false, material);
  addLid(scene, first + (rings - 1) * count, count, true, material);
}

void
addCylinder(TriangleScene& scene,
            const Eigen::Vector3d& foot,
            double radius,
            double height,
            const Surface& material)
{
  addRevolved(scene, {foot, {{radius, 0}, {radius, height}}, 24}, material);
}

void
addStairs(TriangleScene& scene, const Stairs& stairs, const Surface& material)
{
  const double length = (stairs.to - stairs.from).norm();
  require(length > 0, "length of stairs", length, "> 0");
  require(stairs.width > 0, "width of stairs", stairs.width, "> 0");
  require(stairs.steps >= 1 && stairs.steps <= 10000,
          "steps of stairs",
          stairs.steps,
          "in [1, 10000]");
  require(stairs.from_height > stairs.bottom,
          "from_height of stairs",
          stairs.from_height,
          "> bottom");
  require(stairs.to_height > stairs.from_height,
          "to_height of stairs",
          stairs.to_height,
          "> from_height");
  const Eigen::Vector2d ahead = (stairs.to - stairs.from) / length;
  const double tread = length / stairs.steps;
  const double riser = (stairs.to_height - stairs.from_height) / stairs.steps;
  for (int i = 0; i < stairs.steps; ++i) {
    const double top =
        i + 1 == stairs.steps ? stairs.to_height : stairs.from_height + (i + 1) * riser;
    // A ramp without rise: a box along any direction without an angle.
    addRamp(scene,
            {stairs.from + i * tread * ahead,
             stairs.from + (i + 1) * tread * ahead,
             stairs.width,
             stairs.bottom,
             top,
             top},
            material);
  }
}

void
addMesh(TriangleScene& scene,
        const TriangleMesh& mesh,
        const Eigen::Isometry3d& T_scene_mesh,
        const Surface& material)
{
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const std::uint32_t surface = scene.addSurface(material);
  for (const auto& vertex : mesh.vertices)
    scene.vertices.push_back(T_scene_mesh * vertex);
  for (const auto& triangle : mesh.triangles)
    scene.triangles.push_back(
        {{first + triangle[0], first + triangle[1], first + triangle[2]}, surface});
}

void
addModel(TriangleScene& scene,
         const TriangleScene& model,
         const Eigen::Isometry3d& T_scene_model,
         std::uint32_t object)
{
  const auto first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  const auto first_surface = static_cast<std::uint32_t>(scene.surfaces.size());
  for (const auto& vertex : model.vertices)
    scene.vertices.push_back(T_scene_model * vertex);
  for (auto surface : model.surfaces) {
    if (object != 0)
      surface.object = object;
    scene.addSurface(surface);
  }
  for (auto triangle : model.triangles) {
    for (auto& vertex : triangle.vertices)
      vertex += first_vertex;
    triangle.surface += first_surface;
    scene.triangles.push_back(triangle);
  }
}

} // namespace pcl6d
