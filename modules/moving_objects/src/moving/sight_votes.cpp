// SPDX-License-Identifier: BSD-3-Clause
#include "sight_votes.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace pcl6d::moving_objects {

namespace {
constexpr std::size_t kLookedAtOnce = 2048;

/** The most observers of a scan: the number of bits of Votes. */
constexpr std::size_t kMostObservers = 16;

/** Sampled points for the choice of observers: a share of 5 % is estimated to a quarter. */
constexpr std::size_t kSample = 256;

/** [standard deviations] Points this near to a surface are on the surface. */
constexpr float kOnSurfaceSigmas = 3;

/** [voxels] Largest distance of a surface point from its nearest reduced point: points of
 * neighbouring voxels are up to twice the diagonal's half apart. */
constexpr double kReach = 1.75;

/** The normal of a reduced point is valid for its patch: a voxel away, the surface may deviate
 * from the plane by this share of a voxel, by its curvature. */
constexpr float kBend = 0.1F;

/** The error of the poses of two scans comes from this quantile of the distances of points near
 * a surface of both: half of a normal distribution is within 0.6745 deviations. */
constexpr double kMeetingShare = 0.5;
constexpr double kMeetingSigmas = 0.6745;
constexpr std::size_t kLeastMeeting = 16;
} // namespace

Observer::Observer(const SeenScan& observer,
                   const SeenScan& observed,
                   std::ptrdiff_t later)
: observer_(&observer)
, later_(later)
, T_observer_observed_(
      (observer.T_world_scan.inverse() * observed.T_world_scan).cast<float>())
, noise_(observed.rays ? observed.rays->noise() : 0)
, variance_(observer.sigma.translation * observer.sigma.translation +
            observed.sigma.translation * observed.sigma.translation)
, turn_of_observed_(observed.sigma.rotation)
, turn_of_observer_(observer.sigma.rotation)
{}

float
Observer::sigmaOf(const Eigen::Vector3f& place, const Eigen::Vector3f& seen) const
{
  const double a = turn_of_observed_ * place.norm(),
               b = turn_of_observer_ * seen.norm();
  return static_cast<float>(std::sqrt(noise_ * noise_ + variance_ + a * a + b * b));
}

std::vector<SightOfPlace>
Observer::look(const Points& places, const std::vector<float>& deviations) const
{
  Points seen;
  std::vector<float> sigmas;
  seen.reserve(places.size());
  sigmas.reserve(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    seen.emplace_back(T_observer_observed_ * places[k]);
    const float sigma = sigmaOf(places[k], seen.back());
    sigmas.push_back(deviations.empty()
                         ? sigma
                         : std::sqrt(sigma * sigma + deviations[k] * deviations[k]));
  }
  return observer_->rays->look(seen, sigmas);
}

bool
Observer::isMiss(const SightOfPlace& seen,
                 const Eigen::Vector3f& place,
                 const Eigen::Vector3f& normal) const
{
  return passedThrough(seen,
                       T_observer_observed_.linear() * normal,
                       T_observer_observed_ * place - observer_->rays->origin());
}

/** \return [m] across the surface, at a point in the observer's frame; empty without a surface */
std::optional<float>
Observer::distanceToSurface(const Eigen::Vector3f& seen) const
{
  const auto reach = static_cast<float>(kReach * observer_->voxel);
  const Neighbour nearest = observer_->tree->nearest(seen, reach * reach);
  if (nearest.index < 0)
    return std::nullopt;
  const auto at = static_cast<std::size_t>(nearest.index);
  const Eigen::Vector3f off = seen - (*observer_->surface)[at];
  const Eigen::Vector3f& normal = (*observer_->normals)[at];
  const float across = normal.isZero() ? off.norm() : std::abs(normal.dot(off));
  return std::max(0.0F, across - kBend * off.norm());
}

void
Observer::calibrate(const Points& sample)
{
  if (!hasSurface())
    return;
  std::vector<float> apart;
  for (const Eigen::Vector3f& place : sample)
    if (const auto distance = distanceToSurface(T_observer_observed_ * place))
      apart.push_back(*distance);
  if (apart.size() < kLeastMeeting)
    return;
  const auto at = static_cast<std::ptrdiff_t>(kMeetingShare *
                                              static_cast<double>(apart.size() - 1));
  std::nth_element(apart.begin(), apart.begin() + at, apart.end());
  const double sigma = apart[static_cast<std::size_t>(at)] / kMeetingSigmas;
  const double own = observer_->rays->noise();
  variance_ = std::max(variance_, sigma * sigma - noise_ * noise_ - own * own);
}

bool
Observer::tellsWhere(const Eigen::Vector3f& place) const
{
  const double own = observer_->rays->noise();
  const double sigma = sigmaOf(place, T_observer_observed_ * place);
  return kOnSurfaceSigmas * std::sqrt(sigma * sigma + own * own) + gapAt(place) <=
         kReach * observer_->voxel;
}

bool
Observer::supports(const Eigen::Vector3f& place) const
{
  if (!hasSurface())
    return true;
  const Eigen::Vector3f seen = T_observer_observed_ * place;
  const auto distance = distanceToSurface(seen);
  const float own = static_cast<float>(observer_->rays->noise());
  const float sigma = sigmaOf(place, seen);
  return distance &&
         *distance <= kOnSurfaceSigmas * std::sqrt(sigma * sigma + own * own);
}

Eigen::Vector3f
normalOf(const SeenScan& scan, const Eigen::Vector3f& place)
{
  if (!scan.surface)
    return Eigen::Vector3f::Zero();
  const auto reach = static_cast<float>(kReach * scan.voxel);
  const Neighbour nearest = scan.tree->nearest(place, reach * reach);
  return nearest.index < 0 ? Eigen::Vector3f::Zero()
                           : (*scan.normals)[static_cast<std::size_t>(nearest.index)];
}

ObserverVotes::ObserverVotes(std::vector<Observer> candidates,
                             const SeenScan& observed,
                             const Points& places,
                             unsigned int num_threads)
: candidates_(std::move(candidates))
, observed_(observed)
, places_(places)
, num_threads_(num_threads)
, votes_(places.size())
{}

void
ObserverVotes::ask(const std::vector<std::uint32_t>& which,
                   std::size_t first,
                   std::size_t end)
{
  parallelBlocks(which.size(), kLookedAtOnce, num_threads_, [&](const Block& block) {
    look(which, block.begin, block.end, {first, std::min(end, observers_.size())});
  });
}

/** The next observer: the scan with most information on the least observed points. */
std::size_t
ObserverVotes::choose(const std::vector<std::uint32_t>& which, std::size_t count)
{
  Points sample;
  const std::size_t step = std::max<std::size_t>(1, which.size() / kSample);
  for (std::size_t i = 0; i < which.size(); i += step)
    sample.push_back(places_[which[i]]);
  const std::size_t first = observers_.size();
  count = std::min(count, kMostObservers - first);
  std::vector<std::vector<std::uint8_t>> says(candidates_.size()); // of each point
  parallelFor(candidates_.size(), num_threads_, [&](std::size_t c) {
    for (const SightOfPlace& seen : candidates_[c].look(sample))
      says[c].push_back(
          seen.sight == Sight::kFree || seen.sight == Sight::kConfirmed ? 1 : 0);
  });
  std::vector<double> worth(sample.size(), 1);
  std::vector<Observer> rest;
  std::vector<bool> taken(candidates_.size(), false);
  for (std::size_t n = 0; n < count; ++n) {
    std::size_t best = candidates_.size();
    double most = 0;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      double sum = 0;
      for (std::size_t p = 0; !taken[c] && p < sample.size(); ++p)
        sum += says[c][p] * worth[p];
      if (sum > most) {
        most = sum;
        best = c;
      }
    }
    if (best == candidates_.size())
      break;
    taken[best] = true;
    observers_.push_back(candidates_[best]);
    observers_.back().calibrate(sample);
    for (std::size_t p = 0; p < sample.size(); ++p)
      worth[p] /= says[best][p] ? 2 : 1;
  }
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (!taken[c])
      rest.push_back(candidates_[c]);
  candidates_ = std::move(rest);
  orderInTime(first);
  return observers_.size();
}

/** Sorts the new observers: the farthest in time first, because these detect slow motion best. */
void
ObserverVotes::orderInTime(std::size_t first)
{
  const auto nearer = [](const Observer& a, const Observer& b) {
    return std::abs(a.later()) < std::abs(b.later()) ||
           (std::abs(a.later()) == std::abs(b.later()) && a.later() < b.later());
  };
  std::sort(observers_.begin() + static_cast<std::ptrdiff_t>(first),
            observers_.end(),
            [&](const Observer& a, const Observer& b) { return nearer(b, a); });
  before_.clear();
  after_.clear();
  for (std::size_t j = 0; j < observers_.size(); ++j)
    (observers_[j].later() < 0 ? before_ : after_).push_back(j);
  for (auto* side : {&before_, &after_})
    std::sort(side->begin(), side->end(), [&](std::size_t a, std::size_t b) {
      return nearer(observers_[a], observers_[b]);
    });
}

std::uint16_t
ObserverVotes::lastingHits(std::size_t place) const
{
  const Votes& vote = votes_[place];
  unsigned lasting = 0;
  for (const auto* side : {&before_, &after_}) {
    bool was_gone = false;
    for (const std::size_t j : *side) {
      was_gone = was_gone || (vote.misses >> j & 1U) != 0;
      if (was_gone)
        lasting |= vote.hits & 1U << j;
    }
  }
  return static_cast<std::uint16_t>(lasting);
}

void
ObserverVotes::look(const std::vector<std::uint32_t>& which,
                    std::size_t begin,
                    std::size_t end,
                    Bench bench)
{
  Points some;
  for (std::size_t i = begin; i < end; ++i)
    some.push_back(places_[which[i]]);
  std::vector<Eigen::Vector3f> normals(some.size());
  std::vector<bool> is_known(some.size(), false);
  for (std::size_t j = bench.first; j < bench.end; ++j) {
    const unsigned bit = 1U << j;
    const auto seen = observers_[j].look(some);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      Votes& vote = votes_[which[begin + k]];
      if (seen[k].sight == Sight::kConfirmed)
        vote.hits = static_cast<std::uint16_t>(vote.hits | bit);
      if (seen[k].sight != Sight::kFree)
        continue;
      if (!is_known[k])
        normals[k] = normalOf(observed_, some[k]);
      is_known[k] = true;
      if (observers_[j].isMiss(seen[k], some[k], normals[k]))
        vote.misses = static_cast<std::uint16_t>(vote.misses | bit);
    }
  }
  for (std::size_t i = begin; i < end; ++i)
    checkSurfaces(which[i], bench);
}

/** Without a miss at a place, the surface test is used only for hits whose rays are too
 * inaccurate. */
void
ObserverVotes::checkSurfaces(std::size_t place, Bench bench)
{
  Votes& vote = votes_[place];
  for (std::size_t j = bench.first; j < bench.end; ++j) {
    if (!observers_[j].hasSurface())
      continue;
    const unsigned bit = 1U << j;
    if (vote.misses == 0 &&
        ((vote.hits & bit) == 0 || observers_[j].tellsWhere(places_[place])))
      continue;
    const bool on_surface = observers_[j].supports(places_[place]);
    vote.hits =
        static_cast<std::uint16_t>(on_surface ? vote.hits | bit : vote.hits & ~bit);
    if (on_surface)
      vote.misses = static_cast<std::uint16_t>(vote.misses & ~bit);
  }
}

} // namespace pcl6d::moving_objects
