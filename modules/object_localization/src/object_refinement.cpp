// SPDX-License-Identifier: BSD-3-Clause
#include "object_refinement.h"

#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/icp_model.h>

#include <algorithm>

namespace pcl6d {

namespace {
/** The part of a model that faces the scanner, which is at the origin of the scene. */
OrientedPoints
facingPart(const OrientedPoints& model, const Eigen::Isometry3d& T_scene_model)
{
  const Eigen::Vector3d scanner = T_scene_model.inverse().translation();
  OrientedPoints part;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Eigen::Vector3d sight = scanner - model.points[i].cast<double>();
    if (sight.dot(model.normals[i].cast<double>()) > 0) {
      part.points.push_back(model.points[i]);
      part.normals.push_back(model.normals[i]);
    }
  }
  return part;
}

IcpOptions
surfaceIcp(double voxel)
{
  IcpOptions options;
  options.metric = Metric::kGicp;
  options.facing_normals = true;
  options.max_iterations = 30;
  options.max_distance = 2 * voxel;
  options.max_distance_start = 5 * voxel;
  options.distance_decay = 0.8;
  options.translation_epsilon = 0.01 * voxel;
  options.rotation_epsilon = 1e-3;
  options.num_threads = 1; // many candidates are refined side by side
  return options;
}

/** All points of the scan around an object. */
Points
pointsAround(const LocalizationScene& scene,
             const OrientedPoints& model,
             const Eigen::Isometry3d& T_scene_model,
             double rim,
             std::vector<std::uint32_t>& places)
{
  Eigen::AlignedBox3d box;
  for (const auto& p : model.points)
    box.extend(p.cast<double>());
  box.extend(box.min() - Eigen::Vector3d::Constant(rim));
  box.extend(box.max() + Eigen::Vector3d::Constant(rim));
  const Eigen::Vector3d middle = T_scene_model * box.center();
  const double reach = 0.5 * box.diagonal().norm();
  auto near = scene.tree().withinRadius(middle.cast<float>(),
                                        static_cast<float>(reach * reach));
  std::sort(near.begin(), near.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.index < b.index;
  });
  const Eigen::Isometry3d T_model_scene = T_scene_model.inverse();
  Points around;
  for (const auto& neighbour : near) {
    const auto& p = scene.points()[static_cast<std::size_t>(neighbour.index)];
    if (box.contains(T_model_scene * p.cast<double>())) {
      around.push_back(p);
      places.push_back(static_cast<std::uint32_t>(neighbour.index));
    }
  }
  return around;
}
} // namespace

ObjectCandidate
refineOnSurface(const LocalizationScene& scene,
                const SceneSurface& surface,
                const OrientedPoints& model,
                const Eigen::Isometry3d& guess,
                double voxel)
{
  const IcpTarget target{
      {&surface.tree, &surface.oriented.points, &surface.oriented.normals}};
  IcpOptions options = surfaceIcp(voxel);
  ObjectCandidate candidate{guess, {}};
  for (int round = 0; round < 2; ++round) {
    const OrientedPoints facing = facingPart(model, candidate.T_scene_model);
    if (facing.size() < 10)
      return candidate;
    const IcpResult result = icp(
        target, {&facing.points, &facing.normals}, candidate.T_scene_model, options);
    candidate.T_scene_model = result.T_target_source;
    options.max_distance_start = 0;
  }
  candidate.check = checkPose(
      scene, surface.oriented, surface.tree, model, candidate.T_scene_model, voxel);
  return candidate;
}

LocalizedObject
refineOnPoints(const LocalizationScene& scene,
               const OrientedPoints& model,
               const ObjectCandidate& candidate,
               double voxel)
{
  LocalizedObject object;
  object.T_scene_object = candidate.T_scene_model;
  object.rms = candidate.check.rms;
  std::vector<std::uint32_t> places;
  IcpModel::Options making;
  making.normals = true;
  making.normal_voxel = voxel;
  const IcpModel around(
      pointsAround(scene, model, candidate.T_scene_model, voxel, places), making);
  const OrientedPoints facing = facingPart(model, candidate.T_scene_model);
  IcpOptions options;
  options.metric = Metric::kPlane;
  options.max_distance = voxel;
  options.translation_epsilon = 1e-6;
  options.rotation_epsilon = 1e-6;
  const IcpResult result = icp({around.part()},
                               {&facing.points, &facing.normals},
                               candidate.T_scene_model,
                               options);
  object.status = result.status;
  if (result.status == Status::kTooFewPairs || result.status == Status::kDiverged)
    return object;
  object.T_scene_object = result.T_target_source;
  object.covariance = result.covariance;
  object.rms = result.residual;
  const PointTree placed(transformed(facing.points, object.T_scene_object));
  const auto reach = static_cast<float>(voxel);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (placed.nearest(around.points()[i], reach * reach).index >= 0)
      object.points.push_back(places[i]);
  return object;
}

} // namespace pcl6d
