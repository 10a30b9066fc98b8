// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/joint_placement.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/place_by_guesses.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace global_registration;

namespace {
/** Number of scans, the most likely, to match with from an initial pose without overlap. */
constexpr std::size_t kMatchedAnyway = 3;

/** Candidate poses scored with more points, like the hypotheses of joinScans(). */
constexpr std::size_t kEvaluatedGuesses = 8;

/** Each second point is enough to compare initial poses. */
constexpr std::size_t kCompareEvery = 2;

/** The other scans, followed by the scan. */
struct Surroundings {
  Surroundings(const PlaceableScan& scan, const std::vector<KnownScan>& others)
  {
    for (const auto& other : others)
      list.push_back(other.scan);
    list.push_back(&scan);
    for (std::size_t i = 0; i < others.size(); ++i)
      group.add(i, others[i].T_world_scan);
  }
  ScanList list;
  ScanGroup group{list};
};

void
requireRigid(const Eigen::Isometry3d& pose, const char* name)
{
  if (!isRigid(pose))
    throw BadArgument(std::string(name) + " is not a rigid motion");
}

/** An initial pose, and the pose after matching. */
struct MatchedGuess {
  Place place;
  std::size_t guess = 0;
};

MatchedGuess
matchedFrom(const Surroundings& all,
            const Eigen::Isometry3d& guess,
            std::size_t number,
            double reach)
{
  const std::size_t scan = all.list.size() - 1;
  const double cell = all.list[scan]->cell(), voxel = all.list[scan]->scan().voxel();
  JointSupport at = all.group.support(
      scan, guess, cell, 0.5 * cell, kContradictedStart, kCompareEvery);
  for (std::size_t k = 0; k < std::min(kMatchedAnyway, scan); ++k)
    if (std::find(at.met.begin(), at.met.end(), k) == at.met.end())
      at.met.push_back(k);
  MatchedGuess matched;
  matched.guess = number;
  matched.place.T_group_scan =
      all.group.matched(scan, guess, at.met, 2 * cell + reach, MatchedBy::kFewPoints);
  matched.place.support = all.group.support(scan,
                                            matched.place.T_group_scan,
                                            kMetVoxels * voxel,
                                            kPlaceVoxels * voxel,
                                            kContradictedMatch,
                                            kCompareEvery);
  return matched;
}

/** The best different poses, in falling order. */
std::vector<MatchedGuess>
distinct(std::vector<MatchedGuess> all, double cell)
{
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.place.support.score > b.place.support.score;
  });
  std::vector<MatchedGuess> best;
  for (const auto& one : all)
    if (best.size() < kEvaluatedGuesses && one.place.support.score > 0 &&
        std::none_of(best.begin(), best.end(), [&](const MatchedGuess& other) {
          return areSamePlace(one.place.T_group_scan, other.place.T_group_scan, cell);
        }))
      best.push_back(one);
  return best;
}
} // namespace

void
GuessOptions::validate() const
{
  require(reach >= 0 && std::isfinite(reach), "reach", reach, ">= 0 and finite");
  require(max_ambiguity >= 0 && max_ambiguity <= 1,
          "max_ambiguity",
          max_ambiguity,
          "in [0, 1]");
}

GuessedPlace
placeByGuesses(const PlaceableScan& scan,
               const std::vector<KnownScan>& others,
               const std::vector<Eigen::Isometry3d>& guesses,
               const GuessOptions& options)
{
  options.validate();
  for (const auto& guess : guesses)
    requireRigid(guess, "a guess");
  const Surroundings all(scan, others);
  std::vector<MatchedGuess> matched(guesses.size());
  parallelFor(guesses.size(), options.num_threads, [&](std::size_t i) {
    matched[i] = matchedFrom(all, guesses[i], i, options.reach);
  });
  const auto best = distinct(std::move(matched), scan.cell());
  GuessedPlace found;
  if (best.empty()) {
    found.rejection = RejectReason::kNoSurfacesMeet;
    return found;
  }
  std::vector<Place> places;
  for (const auto& one : best)
    places.push_back(one.place);
  const PlaceHypotheses none(all.list, options.max_ambiguity, options.num_threads, {});
  const JointPlacement placement(
      all.list, none, options.max_ambiguity, options.num_threads);
  const Settled settled = placement.settle(
      all.list.size() - 1, places, all.group, options.usual, options.needs);
  found.accepted = settled.accepted;
  found.T_world_scan = settled.best.T_group_scan;
  found.overlap = settled.best.support.overlap;
  found.contradiction = settled.best.support.contradiction;
  found.ambiguity = settled.ambiguity;
  found.rejection = settled.rejection;
  double nearest = -1;
  for (const auto& one : best) {
    const double off =
        (one.place.T_group_scan.translation() - found.T_world_scan.translation())
            .norm();
    if (nearest < 0 || off < nearest) {
      nearest = off;
      found.guess = one.guess;
    }
  }
  return found;
}

double
contradictionOfPlace(const PlaceableScan& scan,
                     const std::vector<KnownScan>& others,
                     const Eigen::Isometry3d& T_world_scan)
{
  requireRigid(T_world_scan, "T_world_scan");
  const Surroundings all(scan, others);
  const double voxel = scan.scan().voxel();
  return all.group
      .support(all.list.size() - 1,
               T_world_scan,
               kMetVoxels * voxel,
               kPlaceVoxels * voxel,
               kContradictedMatch)
      .contradiction;
}

Rejection
rejectionOfPose(const PlaceableScan& scan,
                const std::vector<KnownScan>& others,
                const Eigen::Isometry3d& T_world_scan,
                PlaceNeeds needs,
                const std::vector<LinkEvidence>& usual,
                unsigned int num_threads)
{
  requireRigid(T_world_scan, "T_world_scan");
  const Surroundings all(scan, others);
  const PlaceHypotheses none(all.list, 1, num_threads, {});
  const JointPlacement placement(all.list, none, 1, num_threads);
  return placement.rejectionOf(
      all.list.size() - 1, T_world_scan, all.group, usual, needs);
}

} // namespace pcl6d
