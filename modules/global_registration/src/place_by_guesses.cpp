// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "joint_placement.h"

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
/** So many of the others are matched with from a guess that meets none: the most likely. */
constexpr std::size_t kMatchedAnyway = 3;

/** So many places are judged by more points, as of those that hypotheses tell of. */
constexpr std::size_t kJudgedGuesses = 8;

/** Half of the points are enough to compare guesses. */
constexpr std::size_t kCompareEvery = 2;

/** The others and, behind them, the scan. */
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

/** A guess, and where matching brought it. */
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

/** The best of those that are not the same place, the best first. */
std::vector<MatchedGuess>
distinct(std::vector<MatchedGuess> all, double cell)
{
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.place.support.score > b.place.support.score;
  });
  std::vector<MatchedGuess> best;
  for (const auto& one : all)
    if (best.size() < kJudgedGuesses && one.place.support.score > 0 &&
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
    found.reason = "none of its surfaces meet those of others";
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
  found.reason = settled.reason;
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

std::string
objectionToPlace(const PlaceableScan& scan,
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
  return placement.objectionTo(
      all.list.size() - 1, T_world_scan, all.group, usual, needs);
}

} // namespace pcl6d
