// SPDX-License-Identifier: BSD-3-Clause
#include "object_refinement.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/object_localization/object_localizer.h>
#include <pcl6d/object_localization/pose_clusters.h>
#include <pcl6d/object_localization/pose_votes.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Surfaces of the refinement are twice as fine as those of the votes. */
constexpr double kRefinement = 0.5;
constexpr double kClusterDistance = 0.1; // of the diameter
constexpr double kClusterAngle = 0.35;   // [rad], 20 deg

/** Normals of points that are reduced already, towards the scanner. */
OrientedPoints
surfaceOf(const Points& points, double voxel, unsigned int num_threads)
{
  ReductionOptions reduction;
  reduction.voxel = voxel;
  OrientedPoints surface;
  surface.points = reducePoints(points, reduction);
  constexpr std::size_t kNeighbours = 14;
  surface.normals = estimateNormals(
      surface.points, PointTree(surface.points, num_threads), kNeighbours, num_threads);
  return surface;
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

bool
isAccepted(const PoseCheck& check,
           std::size_t most_facing,
           const LocalizerOptions& options)
{
  return check.support.size() >= options.min_support &&
         static_cast<double>(check.facing()) >=
             options.min_facing * static_cast<double>(most_facing) &&
         check.visibleFraction() >= options.min_visible &&
         check.freeSpaceViolation() <= options.max_violation;
}

double
scoreOf(const PoseCheck& check)
{
  return check.visibleFraction() * (1 - check.freeSpaceViolation());
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
        return scoreOf(a.check) > scoreOf(b.check);
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
  require(isShare(max_violation), "max_violation", max_violation, "0 to 1");
  require(min_support > 0, "min_support", min_support, "> 0");
  require(
      isShare(max_shared_support), "max_shared_support", max_shared_support, "0 to 1");
}

ObjectLocalizer::ObjectLocalizer(ObjectModel model, const LocalizerOptions& options)
: options_((options.validate(), options))
, model_(std::move(model))
, voxel_(options_.resolution * model_.diameter())
, coarse_(reduceOriented(model_.surface(), voxel_))
, fine_(reduceOriented(model_.surface(), kRefinement * voxel_))
, most_facing_(mostFacing(fine_))
, table_(coarse_, model_.diameter())
{}

std::vector<LocalizedObject>
ObjectLocalizer::locate(const LocalizationScene& scene) const
{
  const double fine_voxel = kRefinement * voxel_;
  const SceneSurface surface(
      surfaceOf(scene.points(), fine_voxel, options_.num_threads));
  const OrientedPoints rough = reduceOriented(surface.oriented, voxel_);
  PoseVoteOptions voting;
  voting.num_threads = options_.num_threads;
  auto poses =
      clusterPoses(voteForPoses(table_, rough, PointTree(rough.points), voting),
                   model_.box().center(),
                   kClusterDistance * model_.diameter(),
                   kClusterAngle);
  poses.resize(
      std::min(poses.size(), static_cast<std::size_t>(options_.max_candidates)));

  std::vector<ObjectCandidate> candidates(poses.size());
  parallelFor(poses.size(), options_.num_threads, [&](std::size_t i) {
    candidates[i] =
        refineOnSurface(scene, surface, fine_, poses[i].T_scene_model, fine_voxel);
  });
  candidates.erase(std::remove_if(candidates.begin(),
                                  candidates.end(),
                                  [&](const auto& candidate) {
                                    return !isAccepted(
                                        candidate.check, most_facing_, options_);
                                  }),
                   candidates.end());
  std::vector<LocalizedObject> objects;
  for (const auto& candidate :
       strongest(std::move(candidates), options_.max_shared_support)) {
    LocalizedObject object =
        refineOnPoints(scene, model_.surface(), candidate, fine_voxel);
    object.object_class = model_.objectClass();
    object.score = scoreOf(candidate.check);
    object.visible_fraction = candidate.check.visibleFraction();
    objects.push_back(std::move(object));
  }
  return objects;
}

} // namespace pcl6d
