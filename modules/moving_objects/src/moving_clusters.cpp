// SPDX-License-Identifier: BSD-3-Clause
#include "moving_clusters.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>

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

/** A thing that others saw in its place has moved if so many saw through most of it: one alone may
 * be where it is not. */
constexpr int kClearJudges = 2;

/** What grows, grows by so many places at most: enough for legs, heads and sides. */
constexpr int kGrowths = 12;

/** A half of a thing reaches a quarter of its length from the middle of that half; the other end is
 * three times as far. What nobody saw through belongs to a thing within so many times the distance
 * from its middle of what was seen through. */
constexpr float kTimesAsFar = 3;

/** A surface that is within so many standard deviations of the middle of a thing may be its own. */
constexpr float kSideSigmas = 3;

constexpr std::size_t kPlacesPerBlock = 256;

constexpr int kNobody = -1;

/** [cells] Narrower things are a single line. Places lie anywhere in their cells, so widthOf() a
 * line is up to 1; two lines have 1.7, and down to 1.25 where points lie closer than cells. */
constexpr double kLineCells = 1.1;

/** [cells] Where places are farther apart, as those of reduced points are, a line tells nothing. */
constexpr double kDenseCells = 1.5;

/** \return how far points spread across the direction in which they spread most */
double
widthOf(const std::vector<Eigen::Vector3d>& points)
{
  const auto count = static_cast<double>(points.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    middle += p / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points)
    scatter += (p - middle) * (p - middle).transpose() / count;
  // Of points spread evenly over a width its variance is width^2 / 12.
  return std::sqrt(12 * std::max(0.0, symmetricEigenvalues<3>(scatter)(1)));
}
} // namespace

MovingClusters::MovingClusters(const JudgedPlaces& judged,
                               const Jury& jury,
                               unsigned int num_threads)
: judged_(judged)
, jury_(jury)
, votes_(jury.votes())
, num_threads_(num_threads)
, mover_(votes_.size(), kNobody)
, excess_(votes_.size(), 0)
{
  for (std::size_t place = 0; place < votes_.size(); ++place) {
    if (votes_[place].misses == 0)
      continue;
    excess_[place] = votes_[place].numMisses() -
                     kHitInMisses * __builtin_popcount(jury.lastingHits(place));
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
    if (2 * hit >= all || !moves(cluster))
      continue;
    for (const std::size_t place : cluster)
      mover_[place] = static_cast<int>(movers_.size());
    const Eigen::Vector3f middle = middleOf(cluster).cast<float>();
    float farthest = 0;
    for (const std::size_t place : cluster)
      farthest = std::max(farthest, (judged_.places[place] - middle).norm());
    movers_.push_back({stayedFor(cluster), middle, kTimesAsFar * farthest});
  }
}

/** \return whether enough scans saw through the cluster: two scans must have seen through most of
 * its places, or one if a single scan says anything of most of them. If it was hit half as often
 * as it was missed, always two: a thing that left is missed as a whole, while of a standing thing
 * one scan misses this part and another scan that part. */
bool
MovingClusters::moves(const std::vector<std::size_t>& cluster) const
{
  int excess = 0;
  std::size_t hits = 0, misses = 0;
  std::vector<std::pair<std::size_t, std::size_t>> of(jury_.judges().size());
  for (const std::size_t place : cluster) {
    excess += excess_[place];
    for (std::size_t j = 0; j < of.size(); ++j) {
      of[j].first += votes_[place].misses >> j & 1U;
      of[j].second += votes_[place].hits >> j & 1U;
    }
  }
  int clear = 0, telling = 0;
  for (const auto& [missed, hit] : of) {
    hits += hit;
    misses += missed;
    clear += 2 * missed >= cluster.size() && 4 * hit <= missed ? 1 : 0;
    telling += 2 * (missed + hit) >= cluster.size() ? 1 : 0;
  }
  const bool was_seen_there = 2 * hits > misses;
  if (clear < (was_seen_there ? kClearJudges : std::min(kClearJudges, telling)))
    return false;
  return excess >= kLeastMisses && !isPassedBeside(cluster);
}

Eigen::Vector3d
MovingClusters::middleOf(const std::vector<std::size_t>& cluster) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t place : cluster)
    sum += judged_.places[place].cast<double>();
  return sum / static_cast<double>(cluster.size());
}

/** Whether some hit most of a cluster that is thinner than the gaps between the rays of all who
 * saw through it, as a pole: these may have passed beside it. */
bool
MovingClusters::isPassedBeside(const std::vector<std::size_t>& cluster) const
{
  const Eigen::Vector3d middle = middleOf(cluster);
  std::vector<Eigen::Vector3d> places;
  places.reserve(cluster.size());
  for (const std::size_t place : cluster)
    places.push_back(judged_.places[place].cast<double>());
  const double width = widthOf(places);
  bool is_hit = false;
  for (std::size_t j = 0; j < jury_.judges().size(); ++j) {
    std::size_t hit = 0, missed = 0;
    for (const std::size_t place : cluster) {
      hit += votes_[place].hits >> j & 1U;
      missed += votes_[place].misses >> j & 1U;
    }
    is_hit = is_hit || 2 * hit > cluster.size();
    if (2 * missed > cluster.size() &&
        jury_.judges()[j].gapAt(middle.cast<float>()) < width)
      return false;
  }
  return is_hit;
}

/** \return who saw a thing that moved where it is, as it stayed for a while: those who hit most
 * of it */
std::uint16_t
MovingClusters::stayedFor(const std::vector<std::size_t>& cluster) const
{
  unsigned stayed = 0;
  for (std::size_t j = 0; j < jury_.judges().size(); ++j) {
    std::size_t hit = 0;
    for (const std::size_t place : cluster)
      hit += votes_[place].hits >> j & 1U;
    stayed |= 2 * hit > cluster.size() ? 1U << j : 0U;
  }
  return static_cast<std::uint16_t>(stayed);
}

/** \return whether a place may be of the surface of a mover: then what is known of the mover lies
 * behind that surface, or on it, seen from the scanner. It stands before the ground and the walls
 * about it. */
bool
MovingClusters::isSideOf(const Mover& mover, std::size_t place) const
{
  const Eigen::Vector3f& at = judged_.places[place];
  if ((mover.middle - at).norm() > mover.reach)
    return false;
  const Eigen::Vector3f normal = normalOf(jury_.judged(), at);
  const float side = normal.dot(judged_.origin - at) < 0 ? -1 : 1; // to the scanner
  return !normal.isZero() && side * normal.dot(mover.middle - at) <=
                                 kSideSigmas * static_cast<float>(judged_.noise);
}

/** \return the moving thing that a further place belongs to; kNobody: none. At least a quarter of
 * its neighbours must belong to the thing. In addition the place is hit, or more than half of its
 * neighbours move (both only for places near the thing), or it lies where the front of the thing
 * would be (isSideOf()). A place on a surface of a scan that came when the thing was gone belongs
 * to none. */
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
    return owner; // things passed there at several times
  for (std::size_t j = 0; j < jury_.judges().size(); ++j)
    if ((hits & ~stayed & 1U << j) != 0 &&
        jury_.judges()[j].supports(judged_.places[place]))
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
    std::vector<int> owners; // as all were before this round
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

/** Drops each thing that is a single line of cells, seen from the scanner. The edge of a table
 * looks like this: the scanner sees the top at a flat angle, so that its last row of points lies
 * along the edge, and rays of other scans pass beside it by the error of the poses. */
void
MovingClusters::dropLines()
{
  std::vector<std::vector<Eigen::Vector3d>> directions(movers_.size());
  std::vector<std::size_t> dense(movers_.size(), 0);
  for (std::size_t place = 0; place < mover_.size(); ++place) {
    if (mover_[place] == kNobody)
      continue;
    const auto mover = static_cast<std::size_t>(mover_[place]);
    const Eigen::Vector3d ray = (judged_.places[place] - judged_.origin).cast<double>();
    directions[mover].push_back(ray.normalized());
    const auto nearest = tree_.nearestK(judged_.places[place], 2);
    const double apart = kDenseCells * judged_.cell * ray.norm();
    dense[mover] += nearest.size() == 2 && nearest[1].distance_sq < apart * apart;
  }
  std::vector<bool> is_line;
  for (std::size_t m = 0; m < directions.size(); ++m)
    is_line.push_back(2 * dense[m] > directions[m].size() &&
                      widthOf(directions[m]) < kLineCells * judged_.cell);
  for (int& mover : mover_)
    if (mover != kNobody && is_line[static_cast<std::size_t>(mover)])
      mover = kNobody;
}

std::vector<PointMotion>
MovingClusters::decide()
{
  if (!candidates_.empty()) {
    tree_ = PointTree(judged_.places, num_threads_);
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
