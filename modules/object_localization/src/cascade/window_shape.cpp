// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/training_images.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl6d {
namespace {
constexpr double kMargin = 1.25; // of the window over the object

Eigen::AlignedBox3d
boxOf(const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles)
    for (const auto vertex : triangle)
      box.extend(mesh.vertices[vertex]);
  return box;
}

void
checkSize(const Eigen::AlignedBox3d& box)
{
  if (box.isEmpty())
    throw BadArgument("the model has no triangle");
  const double diameter = box.diagonal().norm();
  if (diameter <= ObjectModel::kLargestDiameter)
    return;
  std::ostringstream message;
  message << "the model is " << diameter << " m large, but must be at most "
          << ObjectModel::kLargestDiameter
          << " m: for a model in millimetres use the scale 0.001";
  throw BadArgument(message.str());
}
} // namespace

double
WindowShape::pixelFor(double distance) const
{
  constexpr double kStep = 1e-5; // resolution of the numbers in a cascade's file
  const double finest = std::floor(object_size / distance / height / kStep) * kStep;
  return std::min(DetectionViewOptions().pixel, std::max(finest, 100 * kStep));
}

TriangleMesh
meshOfPoints(const ObjectModel& model)
{
  const double spacing = model.diameter() / 60;
  const OrientedPoints surface = reduceOriented(model.surface(), spacing);
  const double half = 0.9 * spacing; // neighbours overlap
  TriangleMesh mesh;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3d middle = surface.points[i].cast<double>();
    const Eigen::Vector3d normal = surface.normals[i].cast<double>();
    const Eigen::Vector3d u = half * normal.unitOrthogonal(), v = normal.cross(u);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(middle - u - v);
    mesh.vertices.emplace_back(middle + u - v);
    mesh.vertices.emplace_back(middle + u + v);
    mesh.vertices.emplace_back(middle - u + v);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

WindowShape
windowShapeOf(const std::vector<TriangleMesh>& models)
{
  constexpr double kPixels = 576;
  require(!models.empty(), "number of models", models.size(), "> 0");
  double width = 0, height = 0; // [m]
  for (const auto& mesh : models) {
    const Eigen::AlignedBox3d box = boxOf(mesh);
    checkSize(box);
    const Eigen::Vector3d size = box.sizes();
    // Turned about the vertical, the visible width is between the longer side and the
    // diagonal.
    const double across =
        (std::max(size.x(), size.y()) + std::hypot(size.x(), size.y())) / 2;
    width = std::max(width, across);
    height = std::max(height, size.z());
  }
  const double aspect = std::clamp(width / height, 0.5, 2.0);
  WindowShape shape;
  shape.width = static_cast<int>(std::floor(std::sqrt(kPixels * aspect) + 0.5));
  shape.height = static_cast<int>(std::floor(std::sqrt(kPixels / aspect) + 0.5));
  shape.object_size = kMargin * std::max(height, width / aspect);
  return shape;
}

} // namespace pcl6d
