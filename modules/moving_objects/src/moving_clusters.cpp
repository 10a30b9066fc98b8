// SPDX-License-Identifier: BSD-3-Clause
#include "moving_clusters.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/parallel.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d::moving_objects {

namespace {
/** A hit counts as so many misses: rays pass beside thin things, but never end at nothing. */
constexpr int kHitInMisses = 2;

/** Places so many cells apart are neighbours: one that is empty may lie between them, and
 * cells are squares. */
constexpr double kNearCells = 3;
/** Or so many standard deviations: what differs by noise alone is near. */
constexpr double kNearSigmas = 6;

/** A cluster with fewer misses, less twice its hits, may be chance: the least number of points
 * that say something of a patch of sightEvidence(). */
constexpr int kLeastMisses = 4;

/** What grows, grows by so many places at most: enough for legs, heads and sides. */
constexpr int kGrowths = 12;

constexpr std::size_t kPlacesPerBlock = 256;
} // namespace

MovingClusters::MovingClusters(const JudgedPlaces& judged,
                               const std::vector<Votes>& votes,
                               const std::vector<Judge>& judges,
                               unsigned int num_threads)
: judged_(judged)
, votes_(votes)
, judges_(judges)
, num_threads_(num_threads)
, dynamic_(votes.size(), 0)
, supported_(votes.size(), 0)
{
  for (std::size_t place = 0; place < votes.size(); ++place)
    if (isCandidate(place))
      candidates_.push_back(place);
}

bool
MovingClusters::isCandidate(std::size_t place) const
{
  return votes_[place].numMisses() > kHitInMisses * votes_[place].numHits();
}

bool
MovingClusters::isHit(std::size_t place) const
{
  return votes_[place].hits != 0 && !isCandidate(place);
}

float
MovingClusters::reachOf(std::size_t place) const
{
  const double range = (judged_.places[place] - judged_.origin).norm();
  return static_cast<float>(
      std::max(kNearCells * judged_.cell * range, kNearSigmas * judged_.noise));
}

std::vector<Neighbour>
MovingClusters::near(std::size_t place) const
{
  const float reach = reachOf(place);
  return tree_.withinRadius(judged_.places[place], reach * reach);
}

void
MovingClusters::findClusters()
{
  std::vector<std::vector<Neighbour>> around(candidates_.size());
  parallelBlocks(
      candidates_.size(), kPlacesPerBlock, num_threads_, [&](const Block& block) {
        for (std::size_t k = block.begin; k < block.end; ++k)
          around[k] = near(candidates_[k]);
      });
  constexpr std::size_t kNo = static_cast<std::size_t>(-1);
  std::vector<std::size_t> number(votes_.size(), kNo);
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    number[candidates_[k]] = k;
  Components components(candidates_.size());
  std::vector<std::size_t> others(candidates_.size(), 0);
  for (std::size_t k = 0; k < candidates_.size(); ++k)
    for (const Neighbour& n : around[k]) {
      const auto place = static_cast<std::size_t>(n.index);
      if (number[place] != kNo)
        components.join(k, number[place]);
      else if (isHit(place))
        ++others[k];
    }
  std::map<std::size_t, std::vector<std::size_t>> clusters; // by first candidate
  std::map<std::size_t, std::pair<double, double>> strewn;  // hit, all places near
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const std::size_t first = components.firstOf(k);
    clusters[first].push_back(candidates_[k]);
    strewn[first].first += static_cast<double>(others[k]);
    strewn[first].second += static_cast<double>(around[k].size());
  }
  for (const auto& [first, cluster] : clusters) {
    const auto [hit, all] = strewn[first];
    if (2 * hit < all && moves(cluster))
      for (const std::size_t place : cluster)
        dynamic_[place] = 1;
  }
}

bool
MovingClusters::moves(const std::vector<std::size_t>& cluster) const
{
  int misses = 0;
  for (const std::size_t place : cluster)
    misses += votes_[place].numMisses() - kHitInMisses * votes_[place].numHits();
  return misses >= kLeastMisses && !continuesPlane(cluster);
}

bool
MovingClusters::continuesPlane(const std::vector<std::size_t>& /*cluster*/) const
{
  return false;
}

/** Whether a place that nobody saw through is a part of what moves around it: where others
 * measured something near, but no surface through it, a quarter of its neighbours will do, as
 * one side of it is enough; where nobody looked, most of them must move. */
bool
MovingClusters::belongs(std::size_t place)
{
  if (supported_[place] == 0) {
    bool on_surface = false;
    for (std::size_t j = 0; j < judges_.size() && !on_surface; ++j)
      on_surface = (votes_[place].hits >> j & 1U) != 0 &&
                   judges_[j].supports(judged_.places[place]);
    supported_[place] = on_surface ? 1 : 2;
  }
  if (supported_[place] == 1 && !isCandidate(place))
    return false;
  std::size_t moving = 0, all = 0;
  for (const Neighbour& n : near(place)) {
    const auto other = static_cast<std::size_t>(n.index);
    if (other == place)
      continue;
    ++all;
    moving += dynamic_[other] ? 1 : 0;
  }
  return votes_[place].hits != 0 ? 4 * moving >= all : 2 * moving > all;
}

void
MovingClusters::grow()
{
  std::vector<std::size_t> front;
  for (std::size_t place = 0; place < dynamic_.size(); ++place)
    if (dynamic_[place])
      front.push_back(place);
  for (int round = 0; round < kGrowths && !front.empty(); ++round) {
    std::vector<std::size_t> border;
    for (const std::size_t place : front)
      for (const Neighbour& n : near(place))
        if (!dynamic_[static_cast<std::size_t>(n.index)])
          border.push_back(static_cast<std::size_t>(n.index));
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    front.clear();
    for (const std::size_t place : border) // as all were before this round
      if (belongs(place))
        front.push_back(place);
    for (const std::size_t place : front)
      dynamic_[place] = 1;
  }
}

std::vector<PointMotion>
MovingClusters::decide()
{
  if (!candidates_.empty()) {
    tree_ = PointTree(judged_.places, num_threads_);
    findClusters();
    grow();
  }
  std::vector<PointMotion> motion(votes_.size(), PointMotion::kUnknown);
  for (std::size_t place = 0; place < votes_.size(); ++place)
    if (dynamic_[place])
      motion[place] = PointMotion::kDynamic;
    else if (votes_[place].hits != 0)
      motion[place] = PointMotion::kStatic;
  return motion;
}

} // namespace pcl6d::moving_objects
