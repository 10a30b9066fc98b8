// SPDX-License-Identifier: BSD-3-Clause
#include "edge_lines.h"
#include "mixed_returns.h"
#include "moving_clusters.h"
#include "noisy_clusters.h"
#include "passing_rays.h"
#include "surface_fragments.h"
#include "thin_clusters.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <map>

namespace pcl6d::moving_objects {

namespace {
/** [cells] Neighbours are at most this far apart: an empty cell may lie between two points, and
 * cells are squares. */
constexpr double kNearCells = 3;
/** [standard deviations] Largest difference of neighbours along the ray, by noise alone. */
constexpr double kNearSigmas = 6;

/** A cluster with hits is dynamic if at least this number of scans saw through most of its
 * places: the pose of a single scan may be wrong. */
constexpr int kClearObservers = 2;

/** Rounds of region growing, one neighbour each: enough for legs, heads and sides. */
constexpr int kGrowths = 12;

/** Reach of an object, as multiple of the extent of its seen-through places from their middle.
 * The middle of one half of an object is a quarter of the length from the near end, and three
 * quarters from the far end. */
constexpr float kTimesAsFar = 3;

/** [standard deviations] A surface this near to the middle of an object may be its own. */
constexpr float kSideSigmas = 3;

constexpr std::size_t kPlacesPerBlock = 256;

constexpr int kNobody = -1;
} // namespace

MovingClusters::MovingClusters(const TestedPositions& observed,
                               const ObserverVotes& votes_of_observers,
                               unsigned int num_threads)
: observed_(observed)
, observer_votes_(votes_of_observers)
, votes_(votes_of_observers.votes())
, num_threads_(num_threads)
, mover_(votes_.size(), kNobody)
, excess_(votes_.size(), 0)
{
  for (std::size_t place = 0; place < votes_.size(); ++place) {
    if (votes_[place].misses == 0)
      continue;
    excess_[place] =
        votes_[place].numMisses() -
        kHitInMisses * __builtin_popcount(votes_of_observers.lastingHits(place));
    if (isCandidate(place))
      candidates_.push_back(place);
  }
}

bool
MovingClusters::isCandidate(std::size_t place) const
{
  return excess_[place] > 0;
}

bool
MovingClusters::isHit(std::size_t place) const
{
  return votes_[place].hits != 0 && !isCandidate(place);
}

float
MovingClusters::reachOf(std::size_t place) const
{
  const double range = (observed_.places[place] - observed_.origin).norm();
  return static_cast<float>(
      std::max(kNearCells * observed_.cell * range, kNearSigmas * observed_.noise));
}

std::vector<Neighbour>
MovingClusters::near(std::size_t place) const
{
  const float reach = reachOf(place);
  return tree_.withinRadius(observed_.places[place], reach * reach);
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
  std::map<std::size_t, std::pair<double, double>> strewn;  // hits, and points nearby
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const std::size_t first = components.firstOf(k);
    clusters[first].push_back(candidates_[k]);
    strewn[first].first += static_cast<double>(others[k]);
    strewn[first].second += static_cast<double>(around[k].size());
  }
  for (const auto& [first, cluster] : clusters) {
    const auto [hit, all] = strewn[first];
    if (2 * hit >= all || !moves(cluster))
      continue;
    for (const std::size_t place : cluster)
      mover_[place] = static_cast<int>(movers_.size());
    const Eigen::Vector3f middle = middleOf(observed_, cluster).cast<float>();
    float farthest = 0;
    for (const std::size_t place : cluster)
      farthest = std::max(farthest, (observed_.places[place] - middle).norm());
    movers_.push_back({stayedFor(cluster), middle, kTimesAsFar * farthest});
  }
}

/** \return whether the object of a cluster was gone for other scans. Of a thin object, only scans tell
 * that cannot pass beside it. */
bool
MovingClusters::moves(const std::vector<std::size_t>& cluster) const
{
  constexpr std::uint16_t kAll = 0xFFFF;
  const RayImage& own = *observer_votes_.observed().rays;
  if (!wasGone(cluster, kAll) || areMixedReturns(observed_, own, cluster))
    return false;
  const bool is_thin =
      !hasSolidPart(observed_, own, cluster) &&
      (isHitByOthers(observer_votes_, cluster) || isPorous(observed_, cluster));
  return !is_thin ||
         wasGone(cluster, observersAsFine(observed_, observer_votes_, cluster));
}

/** \return whether enough scans saw through the cluster: two scans must have seen through most
 * of its points, or one if only a single scan observed most of the points. If the hits are
 * half of the misses or more, two are always needed: every observer misses an object that
 * left, while different scans miss different parts of a static object.
 * \param[in] telling observers whose misses count, a bit for each */
bool
MovingClusters::wasGone(const std::vector<std::size_t>& cluster,
                        std::uint16_t telling) const
{
  int excess = 0;
  std::size_t hits = 0, misses = 0;
  std::vector<std::pair<std::size_t, std::size_t>> of(
      observer_votes_.observers().size());
  for (const std::size_t place : cluster) {
    const unsigned missed = votes_[place].misses & telling;
    excess += __builtin_popcount(missed) -
              kHitInMisses * __builtin_popcount(observer_votes_.lastingHits(place));
    for (std::size_t j = 0; j < of.size(); ++j) {
      of[j].first += missed >> j & 1U;
      of[j].second += votes_[place].hits >> j & 1U;
    }
  }
  int clear = 0, most = 0;
  for (const auto& [missed, hit] : of) {
    hits += hit;
    misses += missed;
    clear += 2 * missed >= cluster.size() && 4 * hit <= missed ? 1 : 0;
    most += 2 * (missed + hit) >= cluster.size() ? 1 : 0;
  }
  const bool was_seen_there = 2 * hits > misses;
  if (clear < (was_seen_there ? kClearObservers : std::min(kClearObservers, most)))
    return false;
  return excess >= kLeastMisses &&
         !PassingRays(observed_, observer_votes_, tree_)
              .isPassedBeside(cluster, telling) &&
         !isNoise(observed_, observer_votes_, tree_, cluster, telling);
}

/** \return the scans that observed a dynamic object while at rest: scans that hit most of its
 * places */
std::uint16_t
MovingClusters::stayedFor(const std::vector<std::size_t>& cluster) const
{
  unsigned stayed = 0;
  for (std::size_t j = 0; j < observer_votes_.observers().size(); ++j) {
    std::size_t hit = 0;
    for (const std::size_t place : cluster)
      hit += votes_[place].hits >> j & 1U;
    stayed |= 2 * hit > cluster.size() ? 1U << j : 0U;
  }
  return static_cast<std::uint16_t>(stayed);
}

/** \return whether a place may belong to the surface of a dynamic object: seen from the
 * scanner, the known points of the object lie behind the surface or on it. The object is in
 * front of the ground and the walls around. */
bool
MovingClusters::isSideOf(const Mover& mover, std::size_t place) const
{
  const Eigen::Vector3f& at = observed_.places[place];
  if ((mover.middle - at).norm() > mover.reach)
    return false;
  const Eigen::Vector3f normal = normalOf(observer_votes_.observed(), at);
  const float side = normal.dot(observed_.origin - at) < 0 ? -1 : 1; // to the scanner
  return !normal.isZero() && side * normal.dot(mover.middle - at) <=
                                 kSideSigmas * static_cast<float>(observed_.noise);
}

/** \return the dynamic object of a further place; kNobody without an object. At least a quarter
 * of the neighbours must belong to the object. In addition, one of three conditions holds: the
 * place is hit; more than half of its neighbours are dynamic (both only near the object); or
 * the place is on the expected front of the object (isSideOf()). A place on a surface measured
 * after the object left belongs to no object. */
int
MovingClusters::ownerOf(std::size_t place, bool is_near) const
{
  std::size_t moving = 0, all = 0;
  unsigned stayed = 0;
  int owner = kNobody;
  for (const Neighbour& n : near(place)) { // the nearest first
    const auto other = static_cast<std::size_t>(n.index);
    if (other == place)
      continue;
    ++all;
    if (mover_[other] == kNobody)
      continue;
    ++moving;
    stayed |= movers_[static_cast<std::size_t>(mover_[other])].stayed;
    owner = owner == kNobody ? mover_[other] : owner;
  }
  const unsigned hits = votes_[place].hits;
  if (owner == kNobody || 4 * moving < all)
    return kNobody;
  if (!(is_near && (hits != 0 || 2 * moving > all)) &&
      !isSideOf(movers_[static_cast<std::size_t>(owner)], place))
    return kNobody;
  if (votes_[place].misses != 0 && votes_[place].numMisses() >= votes_[place].numHits())
    return owner; // objects passed at several times
  for (std::size_t j = 0; j < observer_votes_.observers().size(); ++j)
    if ((hits & ~stayed & 1U << j) != 0 &&
        observer_votes_.observers()[j].supports(observed_.places[place]))
      return kNobody;
  return owner;
}

void
MovingClusters::grow()
{
  std::vector<std::size_t> front;
  for (std::size_t place = 0; place < mover_.size(); ++place)
    if (mover_[place] != kNobody)
      front.push_back(place);
  for (int round = 0; !front.empty(); ++round) {
    std::vector<std::size_t> border;
    for (const std::size_t place : front)
      for (const Neighbour& n : near(place))
        if (mover_[static_cast<std::size_t>(n.index)] == kNobody)
          border.push_back(static_cast<std::size_t>(n.index));
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    std::vector<int> owners; // before this round
    owners.reserve(border.size());
    for (const std::size_t place : border)
      owners.push_back(ownerOf(place, round < kGrowths));
    front.clear();
    for (std::size_t k = 0; k < border.size(); ++k)
      if (owners[k] != kNobody) {
        mover_[border[k]] = owners[k];
        front.push_back(border[k]);
      }
  }
}

/** Removes each object that is a single line of cells, seen from the scanner, or a piece of a larger
 * surface. */
void
MovingClusters::dropParts()
{
  const std::vector<bool> is_line =
      areEdgeLines(observed_, mover_, movers_.size(), num_threads_);
  const std::vector<bool> is_fragment = areFragments(
      observed_, observer_votes_.observed(), mover_, movers_.size(), tree_);
  for (int& mover : mover_) {
    const auto of = static_cast<std::size_t>(mover);
    if (mover != kNobody && (is_line[of] || is_fragment[of]))
      mover = kNobody;
  }
}

std::vector<PointMotion>
MovingClusters::decide()
{
  if (!candidates_.empty()) {
    tree_ = PointTree(observed_.places, num_threads_);
    findClusters();
    grow();
    dropParts();
  }
  std::vector<PointMotion> motion(votes_.size(), PointMotion::kUnknown);
  for (std::size_t place = 0; place < votes_.size(); ++place)
    if (mover_[place] != kNobody)
      motion[place] = PointMotion::kDynamic;
    else if (votes_[place].hits != 0)
      motion[place] = PointMotion::kStatic;
  return motion;
}

} // namespace pcl6d::moving_objects
