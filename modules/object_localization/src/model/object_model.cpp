// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/object_localization/normal_orientation.h>
#include <pcl6d/object_localization/object_model.h>
#include <pcl6d/object_localization/oriented_points.h>

#include <Eigen/Geometry>

#include <cmath>
#include <sstream>

namespace pcl6d {

namespace {
/** \brief Spreads points evenly over a mesh, deterministically, with the normal of the
 * triangle.
 * \param[in] spacing [m] > 0: one point per square of this side */
OrientedPoints
sampleMesh(const TriangleMesh& mesh, double spacing)
{
  // Steps of the plastic number spread points evenly over a square (M. Roberts, "The
  // unreasonable effectiveness of quasirandom sequences", 2018).
  constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;
  OrientedPoints samples;
  double due =
      0.5; // fraction of a point carried over, so that tiny triangles get their share
  double u = 0.5, v = 0.5;
  for (const auto& corners : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[corners[0]];
    const Eigen::Vector3d ab = mesh.vertices[corners[1]] - a;
    const Eigen::Vector3d ac = mesh.vertices[corners[2]] - a;
    const Eigen::Vector3d normal = ab.cross(ac);
    const double area = 0.5 * normal.norm();
    if (!(area > 0))
      continue;
    for (due += area / (spacing * spacing); due >= 1; due -= 1) {
      u += kStepU - (u + kStepU >= 1 ? 1 : 0);
      v += kStepV - (v + kStepV >= 1 ? 1 : 0);
      const bool beyond = u + v > 1; // the other half of the parallelogram
      const Eigen::Vector3d p =
          a + (beyond ? 1 - u : u) * ab + (beyond ? 1 - v : v) * ac;
      samples.points.push_back(p.cast<float>());
      samples.normals.push_back((normal / (2 * area)).cast<float>());
    }
  }
  return samples;
}

constexpr std::size_t kFewestPoints = 10;
constexpr double kSamplesAlong = 100; // points of a mesh along its diameter

Eigen::AlignedBox3d
boxOf(const Points& points)
{
  Eigen::AlignedBox3d box;
  for (const auto& p : points)
    box.extend(p.cast<double>());
  return box;
}

OrientedPoints
finiteOf(const Points& points, const Normals& normals)
{
  OrientedPoints finite;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite()) {
      finite.points.push_back(points[i]);
      if (!normals.empty())
        finite.normals.push_back(normals[i].allFinite() ? normals[i].normalized()
                                                        : Eigen::Vector3f::Zero());
    }
  return finite;
}

/** Estimates missing normals. Estimation orients normals to the origin, which is
 * meaningless for a model. */
void
estimateOutwards(OrientedPoints& surface)
{
  const PointTree tree(surface.points);
  surface.normals = estimateNormals(surface.points, tree);
  orientNormals(surface.normals, surface.points, tree);
}
} // namespace

ObjectModel::ObjectModel(const std::string& object_class, OrientedPoints surface)
: class_(object_class), surface_(std::move(surface)), box_(boxOf(surface_.points))
{
  std::size_t with_normal = 0;
  for (const auto& normal : surface_.normals)
    with_normal += normal.squaredNorm() > 0 ? 1 : 0;
  require(with_normal >= kFewestPoints,
          ("points on a surface of the model " + object_class).c_str(),
          with_normal,
          ">= " + std::to_string(kFewestPoints));
}

ObjectModel
ObjectModel::fromCloud(const std::string& object_class,
                       const Points& points,
                       const Normals& normals)
{
  if (!normals.empty() && normals.size() != points.size())
    throw BadArgument("model " + object_class + ": " + std::to_string(normals.size()) +
                      " normals for " + std::to_string(points.size()) + " points");
  OrientedPoints surface = finiteOf(points, normals);
  require(surface.size() >= kFewestPoints,
          ("finite points of the model " + object_class).c_str(),
          surface.size(),
          ">= " + std::to_string(kFewestPoints));
  if (const double diameter = boxOf(surface.points).diagonal().norm();
      diameter > kLargestDiameter) {
    std::ostringstream message;
    message << "model " << object_class << ": " << diameter
            << " m large, but must be at most " << kLargestDiameter
            << " m: for a model in millimetres use the scale 0.001";
    throw BadArgument(message.str());
  }
  if (surface.normals.empty())
    estimateOutwards(surface);
  return {object_class, std::move(surface)};
}

ObjectModel
ObjectModel::fromMesh(const std::string& object_class, const TriangleMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices)
    box.extend(vertex);
  const double spacing = box.isEmpty() ? 0 : box.diagonal().norm() / kSamplesAlong;
  if (mesh.triangles.empty() || !(spacing > 0))
    throw BadArgument("model " + object_class + ": the mesh has no surface");
  OrientedPoints surface = sampleMesh(mesh, spacing);
  orientNormals(surface.normals, surface.points, PointTree(surface.points));
  return fromCloud(object_class, surface.points, surface.normals);
}

} // namespace pcl6d
