// SPDX-License-Identifier: BSD-3-Clause
#include "pose/object_candidates.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/pose_clusters.h>
#include <pcl6d/object_localization/pose_votes.h>
#include <pcl6d/object_localization/upright_poses.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace object_localization;

namespace {
/** Surface elements of the refinement are half as large as in the votes. */
constexpr double kRefinement = 0.5;
/** Factor on min_agreement before the last step. */
constexpr double kRoughAgreement = 0.6;
/** Per proposal: poses that are compared with the scan, and poses that are refined. */
constexpr std::size_t kPlacings = 120;
constexpr std::size_t kPlacingsRefined = 8;
constexpr double kFieldReach = 3;  // elements
constexpr double kPlacingGate = 3; // elements
/** The gate for poses refined on the surface; elements. */
constexpr double kSurfaceGate = 2;
constexpr double kClusterDistance = 0.1; // of the diameter
constexpr double kClusterAngle = 0.35;   // [rad], 20 deg

/** \return the median distance [m] of a point and its nearest neighbour */
double
spacingOf(const Points& points)
{
  constexpr std::size_t kSamples = 1000;
  const PointTree tree(points);
  const std::size_t stride = points.size() / kSamples + 1;
  std::vector<double> spacings;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    Neighbour near[2];
    if (tree.nearestK(points[i], 2, near) == 2)
      spacings.push_back(std::sqrt(double{near[1].distance_sq}));
  }
  return upperMedian(std::move(spacings));
}

/** \return how many points face the scanner when the most do, over 26 directions */
std::size_t
mostFacing(const OrientedPoints& surface)
{
  std::size_t most = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Eigen::Vector3f side = Eigen::Vector3i(x, y, z).cast<float>();
        const auto faces = [&](const Eigen::Vector3f& n) { return n.dot(side) > 0; };
        const auto count =
            std::count_if(surface.normals.begin(), surface.normals.end(), faces);
        most = std::max(most, static_cast<std::size_t>(count));
      }
  return most;
}

/** \return the shortest rotation with the z axis of R */
Eigen::Matrix3d
withoutTurn(const Eigen::Matrix3d& R)
{
  const Eigen::Vector3d z = R.col(2);
  return shortestRotation(Eigen::Vector3d::UnitZ(), z).toRotationMatrix();
}
} // namespace

void
LocalizerOptions::validate() const
{
  require(
      resolution >= 0.02 && resolution <= 0.2, "resolution", resolution, "0.02 to 0.2");
  require(max_candidates > 0, "max_candidates", max_candidates, "> 0");
  const auto isShare = [](double x) { return x >= 0 && x <= 1; };
  require(isShare(min_visible), "min_visible", min_visible, "0 to 1");
  require(isShare(min_facing), "min_facing", min_facing, "0 to 1");
  require(isShare(min_seen), "min_seen", min_seen, "0 to 1");
  require(isShare(min_agreement), "min_agreement", min_agreement, "0 to 1");
  require(isShare(max_violation), "max_violation", max_violation, "0 to 1");
  require(max_continuation >= 0, "max_continuation", max_continuation, ">= 0");
  require(min_support > 0, "min_support", min_support, "> 0");
  require(
      isShare(max_shared_support), "max_shared_support", max_shared_support, "0 to 1");
}

ObjectLocalizer::ObjectLocalizer(ObjectModel model, const LocalizerOptions& options)
: options_((options.validate(), options))
, model_(std::move(model))
, voxel_(options_.resolution * model_.diameter())
, spacing_(spacingOf(model_.surface().points))
, coarse_(reduceOriented(model_.surface(), voxel_))
, fine_(std::make_shared<const ModelSurface>(model_.surface(), kRefinement * voxel_))
, most_facing_(mostFacing(fine_->surface))
, field_(std::make_shared<const DistanceField>(fine_->surface.points,
                                               fine_->element,
                                               kFieldReach * fine_->element))
, table_(coarse_, model_.diameter())
{}

std::vector<VotedPose>
ObjectLocalizer::firstPoses(const SceneSurface& surface) const
{
  const OrientedPoints rough = reduceOriented(surface.withoutLargePlanes(), voxel_);
  PoseVoteOptions voting;
  voting.num_threads = options_.num_threads;
  auto poses =
      clusterPoses(voteForPoses(table_, rough, PointTree(rough.points), voting),
                   model_.box().center(),
                   kClusterDistance * model_.diameter(),
                   kClusterAngle);
  poses.resize(
      std::min(poses.size(), static_cast<std::size_t>(options_.max_candidates)));
  return poses;
}

bool
ObjectLocalizer::accepts(const PoseCheck& check, double min_agreement) const
{
  return check.support.size() >= options_.min_support &&
         static_cast<double>(check.elements) >=
             options_.min_facing * static_cast<double>(most_facing_) &&
         check.visibleFraction() >= options_.min_visible &&
         check.agreement() >= min_agreement &&
         check.freeSpaceViolation() <= options_.max_violation &&
         check.continuation() <= options_.max_continuation;
}

void
ObjectLocalizer::removeRefused(std::vector<ObjectCandidate>& candidates,
                               double min_agreement) const
{
  const auto isRefused = [&](const auto& c) {
    return !accepts(c.check, min_agreement);
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), isRefused),
                   candidates.end());
}

std::vector<LocalizedObject>
ObjectLocalizer::locate(const LocalizationScene& scene) const
{
  const SceneSurface surface = surfaceOf(scene);
  const ObjectRefinement refinement(scene, surface, *fine_);
  const auto poses = firstPoses(surface);
  std::vector<ObjectCandidate> candidates(poses.size());
  parallelFor(poses.size(), options_.num_threads, [&](std::size_t i) {
    candidates[i] = refinement.onSurface(poses[i].T_scene_model);
  });
  removeRefused(candidates, kRoughAgreement * options_.min_agreement);
  candidates = strongest(std::move(candidates), options_.max_shared_support);
  parallelFor(candidates.size(), options_.num_threads, [&](std::size_t i) {
    candidates[i] = refinement.onPoints(
        candidates[i], model_.surface(), {kSurfaceGate * fine_->element, spacing_});
  });
  const double least = options_.min_seen * static_cast<double>(most_facing_);
  const auto isTooCoarse = [&](const ObjectCandidate& c) {
    return static_cast<double>(c.check.support.size()) < least;
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), isTooCoarse),
                   candidates.end());
  return objectsOf(std::move(candidates));
}

std::vector<LocalizedObject>
ObjectLocalizer::locate(const LocalizationScene& scene,
                        const std::vector<ObjectProposal>& proposals) const
{
  const SceneSurface surface = surfaceOf(scene);
  const ObjectRefinement refinement(scene, surface, *fine_);
  const ModelSurface coarse(model_.surface(), voxel_);
  std::vector<std::vector<ObjectCandidate>> of_proposal(proposals.size());
  parallelFor(proposals.size(), options_.num_threads, [&](std::size_t i) {
    if (mayBe(proposals[i]))
      of_proposal[i] = placed(proposals[i], refinement, coarse);
  });
  std::vector<ObjectCandidate> candidates;
  for (auto& some : of_proposal)
    std::move(some.begin(), some.end(), std::back_inserter(candidates));
  return objectsOf(std::move(candidates));
}

SceneSurface
ObjectLocalizer::surfaceOf(const LocalizationScene& scene) const
{
  return {scene.points(), fine_->element, model_.diameter(), options_.num_threads};
}

/** Whether a proposal is not much larger than the model. */
bool
ObjectLocalizer::mayBe(const ObjectProposal& proposal) const
{
  constexpr double kTaller = 0.2; // [m] of objects on top
  constexpr double kLonger = 0.8; // [m] of touching objects
  const Eigen::Vector3d size = model_.box().sizes();
  return proposal.size.z() < size.z() + kTaller &&
         proposal.size.head<2>().norm() < size.head<2>().norm() + kLonger;
}

/** Upright poses of the model at a proposal, made precise. */
std::vector<ObjectCandidate>
ObjectLocalizer::placed(const ObjectProposal& proposal,
                        const ObjectRefinement& refinement,
                        const ModelSurface& coarse) const
{
  Points points;
  for (const auto place : proposal.points)
    points.push_back(refinement.scene().points()[place]);
  std::vector<ObjectCandidate> candidates;
  for (const auto& pose : uprightPoses(*field_,
                                       model_.box(),
                                       model_.symmetry(),
                                       points,
                                       proposal.T_scene_box,
                                       kPlacings))
    candidates.push_back(refinement.checked(pose.T_scene_model, coarse));
  std::stable_sort(
      candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return explanation(a.check) > explanation(b.check);
      });
  candidates.resize(std::min(candidates.size(), kPlacingsRefined));
  for (auto& candidate : candidates)
    candidate = refinement.onPoints(
        candidate, model_.surface(), {kPlacingGate * fine_->element, spacing_});
  return candidates;
}

std::vector<LocalizedObject>
ObjectLocalizer::objectsOf(std::vector<ObjectCandidate> candidates) const
{
  removeRefused(candidates, options_.min_agreement);
  std::vector<LocalizedObject> objects;
  for (auto& candidate : strongest(std::move(candidates), options_.max_shared_support))
    objects.push_back(describe(std::move(candidate)));
  return objects;
}

LocalizedObject
ObjectLocalizer::describe(ObjectCandidate candidate) const
{
  LocalizedObject object;
  object.object_class = model_.objectClass();
  object.status = candidate.status;
  object.T_scene_object = candidate.T_scene_model;
  if (model_.symmetry().isRound()) { // every turn fits: choose none
    object.status = Status::kRankDeficient;
    object.T_scene_object.linear() = withoutTurn(candidate.T_scene_model.linear());
  }
  else
    object.covariance = candidate.covariance;
  object.score = scoreOf(candidate.check);
  object.visible_fraction = candidate.check.visibleFraction();
  object.rms = candidate.rms;
  object.evidence =
      static_cast<double>(candidate.points.size()) * trust(candidate.check);
  object.points = std::move(candidate.points);
  return object;
}

} // namespace pcl6d
