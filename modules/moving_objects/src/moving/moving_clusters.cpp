// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"
#include "edge_lines.h"
#include "mixed_returns.h"
#include "moving_clusters.h"
#include "thin_clusters.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d::moving_objects {

namespace {
/** [cells] Neighbours are at most this far apart: an empty cell may lie between two points, and
 * cells are squares. */
constexpr double kNearCells = 3;
/** [standard deviations] Largest difference of neighbours along the ray, by noise alone. */
constexpr double kNearSigmas = 6;

/** Largest probability that the rays of all scans passed beside a cluster by chance: 5 %, as in the
 * other tests. */
constexpr double kByChance = 0.05;

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

/** [spacings] A narrower part is a single row of points, which proves no width. */
constexpr double kRowSpacings = 1.1;

/** Number of parts of a surface whose width is measured: the widest quarter decides. */
constexpr std::size_t kWindows = 64;

/** [spacings] Radius of a part of a surface, at least: its neighbours on all sides. */
constexpr double kWindowCells = 1.5;

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
    const Eigen::Vector3f middle = middleOf(cluster).cast<float>();
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
  return excess >= kLeastMisses && !isPassedBeside(cluster, telling);
}

Eigen::Vector3d
MovingClusters::middleOf(const std::vector<std::size_t>& cluster) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t place : cluster)
    sum += observed_.places[place].cast<double>();
  return sum / static_cast<double>(cluster.size());
}

/** \return whether the rays of all scans may have passed beside the places that they missed, by
 * chance. Rays a gap g apart miss a surface of seen extents w and h with probability
 * 1 - min(1, w / g) min(1, h / g), independently for each scan. A surface seen at a flat angle, like
 * the edge of a platform, has almost no width. A cluster that another scan hit, like a pole or the
 * top of a table, is passed beside unless one of the scans must have hit it. */
bool
MovingClusters::isPassedBeside(const std::vector<std::size_t>& cluster,
                               std::uint16_t telling) const
{
  double chance = 1;
  bool is_hit = false;
  for (std::size_t j = 0; j < observer_votes_.observers().size(); ++j) {
    std::size_t hit = 0;
    std::vector<std::size_t> missed;
    for (const std::size_t place : cluster) {
      hit += votes_[place].hits >> j & 1U;
      if ((votes_[place].misses & telling & 1U << j) != 0)
        missed.push_back(place);
    }
    is_hit = is_hit || 2 * hit > cluster.size();
    if (!missed.empty())
      chance *= chanceToPassBeside(missed, observer_votes_.observers()[j]);
  }
  return chance > (is_hit ? 0 : kByChance);
}

/** \return mean square [m^2] of the surface about a place. Range noise spreads the places along their
 * rays, which is no extent of the surface. A place of a reduced scan stands for the points of its voxel,
 * which fill it but for the gap to the next ray. */
Eigen::Matrix3d
MovingClusters::spreadOfPlace(std::size_t place) const
{
  const SeenScan& observed = observer_votes_.observed();
  const Eigen::Vector3f& p = observed_.places[place];
  const Eigen::Vector3d ray = observed_.directionOf(place).cast<double>();
  Eigen::Matrix3d spread = -observed_.noise * observed_.noise * ray * ray.transpose();
  const Eigen::Vector3d normal = normalOf(observed, p).cast<double>();
  const auto next = tree_.nearestK(p, 2);
  if (normal.isZero() || next.size() < 2)
    return spread;
  const double filled = observed.voxel - observed_.cell * (p - observed_.origin).norm();
  const double edge = std::min(std::max(0.0, filled),
                               static_cast<double>(std::sqrt(next[1].distance_sq)));
  return spread +
         edge * edge / 12 * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
}

/** \return the probability that no ray of an observer meets the surface at places. The rays are a gap
 * apart, so the surface within a gap of a place decides: a bent row of points, like the two sides of
 * an edge or the foot and the top of a lamp, is no wider than a straight one. */
double
MovingClusters::chanceToPassBeside(const std::vector<std::size_t>& places,
                                   const Observer& observer) const
{
  const Eigen::Vector3d ray =
      middleOf(places) - observer.originInObserved().cast<double>();
  const double gap = observer.gapAt(middleOf(places).cast<float>());
  Points seen;
  std::vector<Eigen::Matrix3d> spreads;
  for (const std::size_t place : places) {
    const Eigen::Vector3d p = observed_.places[place].cast<double>();
    seen.emplace_back((p - p.dot(ray) / ray.squaredNorm() * ray).cast<float>());
    spreads.push_back(spreadOfPlace(place));
  }
  const PointTree tree(seen, 1);
  std::vector<double> chances;
  const std::size_t step = 1 + (places.size() - 1) / kWindows;
  for (std::size_t k = 0; k < places.size(); k += step) {
    const double own_gap =
        observed_.cell * (observed_.places[places[k]] - observed_.origin).norm();
    const double apart =
        kWindowCells * std::max(own_gap, observer_votes_.observed().voxel);
    const auto radius = static_cast<float>(std::max(gap, apart));
    std::vector<Eigen::Vector3d> at;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Neighbour& n : tree.withinRadius(seen[k], radius * radius)) {
      const auto i = static_cast<std::size_t>(n.index);
      at.push_back(seen[i].cast<double>());
      spread += spreads[i];
    }
    const Eigen::Vector2d extent = seenExtentOf(
        scatterOf(at) + spread / static_cast<double>(at.size()), ray.normalized());
    const Eigen::Vector2d proven =
        (extent.array().square() + own_gap * own_gap).sqrt() - own_gap;
    chances.push_back(extent.x() < kRowSpacings * own_gap
                          ? 1
                          : 1 - (proven / gap).cwiseMin(1).prod());
  }
  return upperMedian(std::move(chances));
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

/** Removes each object that is a single line of cells, seen from the scanner. */
void
MovingClusters::dropLines()
{
  const std::vector<bool> is_line =
      areEdgeLines(observed_, mover_, movers_.size(), num_threads_);
  for (int& mover : mover_)
    if (mover != kNobody && is_line[static_cast<std::size_t>(mover)])
      mover = kNobody;
}

std::vector<PointMotion>
MovingClusters::decide()
{
  if (!candidates_.empty()) {
    tree_ = PointTree(observed_.places, num_threads_);
    findClusters();
    grow();
    dropLines();
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
