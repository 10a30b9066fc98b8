// SPDX-License-Identifier: BSD-3-Clause
#include "object_refinement.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/pose_clusters.h>
#include <pcl6d/object_localization/pose_votes.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Surfaces of the refinement are twice as fine as those of the votes. */
constexpr double kRefinement = 0.5;
/** Before the last step a pose need not agree as well, by this factor. */
constexpr double kRoughAgreement = 0.6;
constexpr double kClusterDistance = 0.1; // of the diameter
constexpr double kClusterAngle = 0.35;   // [rad], 20 deg

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

double
scoreOf(const PoseCheck& check)
{
  return check.visibleFraction() * (1 - check.freeSpaceViolation());
}

/** \return how much of the scan a pose explains, less for what speaks against it: a
 * share of the facing surface would prefer poses that show the scanner a small face */
double
explanation(const PoseCheck& check)
{
  return static_cast<double>(check.support.size()) * check.agreement() *
         (1 - check.freeSpaceViolation());
}

/** \return how much of the smaller support is in the other one, too */
double
sharedSupport(const PoseCheck& a, const PoseCheck& b)
{
  std::vector<std::uint32_t> both;
  std::set_intersection(a.support.begin(),
                        a.support.end(),
                        b.support.begin(),
                        b.support.end(),
                        std::back_inserter(both));
  return static_cast<double>(both.size()) /
         static_cast<double>(std::min(a.support.size(), b.support.size()));
}

/** Leaves out those that explain what a better one explains; best first. */
std::vector<ObjectCandidate>
strongest(std::vector<ObjectCandidate> candidates, double max_shared)
{
  std::stable_sort(
      candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return explanation(a.check) > explanation(b.check);
      });
  std::vector<ObjectCandidate> kept;
  for (auto& candidate : candidates) {
    const auto isSame = [&](const ObjectCandidate& other) {
      return sharedSupport(candidate.check, other.check) > max_shared;
    };
    if (std::none_of(kept.begin(), kept.end(), isSame))
      kept.push_back(std::move(candidate));
  }
  return kept;
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
, coarse_(reduceOriented(model_.surface(), voxel_))
, fine_(std::make_shared<const ModelSurface>(model_.surface(), kRefinement * voxel_))
, most_facing_(mostFacing(fine_->surface))
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
         static_cast<double>(check.facing()) >=
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
  const SceneSurface surface(
      scene.points(), kRefinement * voxel_, model_.diameter(), options_.num_threads);
  const ObjectRefinement refinement(scene, surface, *fine_);
  const auto poses = firstPoses(surface);
  std::vector<ObjectCandidate> candidates(poses.size());
  parallelFor(poses.size(), options_.num_threads, [&](std::size_t i) {
    candidates[i] = refinement.onSurface(poses[i].T_scene_model);
  });
  removeRefused(candidates, kRoughAgreement * options_.min_agreement);
  candidates = strongest(std::move(candidates), options_.max_shared_support);
  parallelFor(candidates.size(), options_.num_threads, [&](std::size_t i) {
    candidates[i] = refinement.onPoints(candidates[i], model_.surface());
  });
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
  object.covariance = candidate.covariance;
  object.score = scoreOf(candidate.check);
  object.visible_fraction = candidate.check.visibleFraction();
  object.rms = candidate.rms;
  object.points = std::move(candidate.points);
  return object;
}

} // namespace pcl6d
