// SPDX-License-Identifier: BSD-3-Clause
#include "pose/object_refinement.h"

#include <pcl6d/object_localization/pose_covariance.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/registration/icp_model.h>

#include <algorithm>
#include <limits>

namespace pcl6d::object_localization {

namespace {
constexpr std::size_t kFewestFacing = 10; // points
/** Tolerance for a correct pose, as a share of the element size. */
constexpr double kStrictness = 0.4;
/** Of the rms: farther pairs are of another surface. */
constexpr double kGate = 3;
constexpr int kRounds = 3;

/** The part of a model that faces the scanner at the origin of the scene. */
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

/** \return evenly spread points, enough to come near */
Points
someOf(const Points& points)
{
  constexpr std::size_t kEnough = 2000;
  const std::size_t stride = points.size() / kEnough + 1;
  Points some;
  for (std::size_t i = 0; i < points.size(); i += stride)
    some.push_back(points[i]);
  return some;
}

/** From the scan's points, which average noise by their number, to the model. */
IcpOptions
pointIcp(double max_distance)
{
  IcpOptions options;
  options.metric = Metric::kPlane;
  options.max_distance = max_distance;
  options.max_iterations = 50;
  options.translation_epsilon = 1e-3 * max_distance;
  options.rotation_epsilon = 1e-5;
  options.num_threads = 1;
  return options;
}
} // namespace

ObjectCandidate
ObjectRefinement::onSurface(const Eigen::Isometry3d& guess) const
{
  const IcpTarget target{
      {&surface_.tree, &surface_.elements.points, &surface_.elements.normals}};
  IcpOptions options = surfaceIcp(voxel_);
  ObjectCandidate candidate;
  candidate.T_scene_model = guess;
  for (int round = 0; round < 2; ++round) {
    const OrientedPoints facing = facingPart(model_.surface, candidate.T_scene_model);
    if (facing.size() < kFewestFacing)
      return candidate;
    candidate.T_scene_model =
        icp(target, {&facing.points, &facing.normals}, candidate.T_scene_model, options)
            .T_target_source;
    options.max_distance_start = 0;
  }
  candidate.check =
      checkPose(scene_, surface_, model_, candidate.T_scene_model, voxel_);
  return candidate;
}

ObjectCandidate
ObjectRefinement::checked(const Eigen::Isometry3d& T_scene_model,
                          const ModelSurface& model) const
{
  ObjectCandidate candidate;
  candidate.T_scene_model = T_scene_model;
  candidate.check = checkPose(scene_, surface_, model, T_scene_model, model.element);
  return candidate;
}

ObjectCandidate
ObjectRefinement::onPoints(const ObjectCandidate& candidate,
                           const OrientedPoints& dense,
                           const PairGate& gate) const
{
  const double least = std::clamp(gate.least, 0.1 * voxel_, voxel_);
  double reach_of_pairs = gate.start;
  std::vector<std::uint32_t> places;
  const Points around = pointsAround(candidate.T_scene_model, dense, places);
  ObjectCandidate refined = candidate;
  for (int round = 0; round < kRounds; ++round) {
    const Points data = round + 1 < kRounds ? someOf(around) : around;
    OrientedPoints facing = facingPart(dense, refined.T_scene_model);
    const IcpModel target(std::move(facing.points), std::move(facing.normals), {});
    const IcpResult result = icp({target.part()},
                                 {&data, nullptr},
                                 refined.T_scene_model.inverse(),
                                 pointIcp(reach_of_pairs));
    if (result.status == Status::kTooFewPairs || result.status == Status::kDiverged) {
      refined.check = {};
      return refined;
    }
    refined.status = result.status;
    refined.T_scene_model = result.T_target_source.inverse();
    refined.covariance = result.covariance ? inverseCovariance(*result.covariance,
                                                               result.T_target_source)
                                           : std::nullopt;
    refined.rms = result.residual;
    reach_of_pairs = std::clamp(kGate * result.residual, least, voxel_);
  }
  refined.points.clear();
  const PointTree placed(transformed(facingPart(dense, refined.T_scene_model).points,
                                     refined.T_scene_model));
  const auto reach = static_cast<float>(voxel_);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (placed.hasNeighbour(around[i], reach * reach))
      refined.points.push_back(places[i]);
  refined.check =
      checkPose(scene_, surface_, model_, refined.T_scene_model, kStrictness * voxel_);
  return refined;
}

/** The points of the scan around an object, without points on large planes. */
Points
ObjectRefinement::pointsAround(const Eigen::Isometry3d& T_scene_model,
                               const OrientedPoints& dense,
                               std::vector<std::uint32_t>& places) const
{
  Eigen::AlignedBox3d box;
  for (const auto& p : dense.points)
    box.extend(p.cast<double>());
  box.extend(box.min() - Eigen::Vector3d::Constant(voxel_));
  box.extend(box.max() + Eigen::Vector3d::Constant(voxel_));
  const Eigen::Vector3d middle = T_scene_model * box.center();
  const double reach = 0.5 * box.diagonal().norm();
  const Eigen::Isometry3d T_model_scene = T_scene_model.inverse();
  const Surfels& surfels = surface_.cloud.surfels();
  for (const auto& near : surface_.tree.withinRadius(
           middle.cast<float>(), static_cast<float>(reach * reach))) {
    const auto element = static_cast<std::size_t>(near.index);
    if (surface_.large[element] ||
        !box.contains(T_model_scene * surface_.elements.points[element].cast<double>()))
      continue;
    places.insert(places.end(),
                  surfels.members.begin() + surfels.begin[element],
                  surfels.members.begin() + surfels.begin[element + 1]);
  }
  std::sort(places.begin(), places.end());
  Points around;
  for (const auto place : places)
    around.push_back(scene_.points()[place]);
  return around;
}

} // namespace pcl6d::object_localization
