// SPDX-License-Identifier: BSD-3-Clause
#include "sight_votes.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl6d::moving_objects {

namespace {
constexpr std::size_t kLookedAtOnce = 2048;

/** Judges of one scan: the bits of Votes. */
constexpr std::size_t kMostJudges = 16;

/** Of so many places it is asked who sees them: a share of 5 % of them is known to a quarter. */
constexpr std::size_t kSample = 256;

/** Points within so many standard deviations of a surface are on it. */
constexpr float kOnSurfaceSigmas = 3;

/** A surface is where its nearest reduced point is, within so many voxels: points of
 * neighbouring voxels are up to twice the diagonal's half apart. */
constexpr double kReach = 1.75;

/** The normal of a reduced point holds for its patch: a place that is off by a voxel may be
 * off the plane by such a share of it, by the bend of the surface. */
constexpr float kBend = 0.1F;

/** \return the normal of the surface of a scan at one of its places; zero: not known */
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
} // namespace

Judge::Judge(const SeenScan& judge, const SeenScan& judged)
: judge_(&judge)
, T_judge_judged_((judge.T_world_scan.inverse() * judged.T_world_scan).cast<float>())
, noise_(judged.rays ? judged.rays->noise() : 0)
, variance_(judge.sigma.translation * judge.sigma.translation +
            judged.sigma.translation * judged.sigma.translation)
, turn_of_judged_(judged.sigma.rotation)
, turn_of_judge_(judge.sigma.rotation)
{}

float
Judge::sigmaOf(const Eigen::Vector3f& place, const Eigen::Vector3f& seen) const
{
  const double a = turn_of_judged_ * place.norm(), b = turn_of_judge_ * seen.norm();
  return static_cast<float>(std::sqrt(noise_ * noise_ + variance_ + a * a + b * b));
}

std::vector<SightOfPlace>
Judge::look(const Points& places) const
{
  Points seen;
  std::vector<float> sigmas;
  seen.reserve(places.size());
  sigmas.reserve(places.size());
  for (const Eigen::Vector3f& place : places) {
    seen.emplace_back(T_judge_judged_ * place);
    sigmas.push_back(sigmaOf(place, seen.back()));
  }
  return judge_->rays->look(seen, sigmas);
}

bool
Judge::isMiss(const SightOfPlace& seen,
              const Eigen::Vector3f& place,
              const Eigen::Vector3f& normal) const
{
  if (normal.isZero())
    return true;
  const Eigen::Vector3f ray = T_judge_judged_ * place - judge_->rays->origin();
  const float slope =
      std::abs((T_judge_judged_.linear() * normal).dot(ray.normalized()));
  // look() tells the distance in thirds of its tolerance, which is right from 45 deg on.
  const float tolerance = 3 * seen.beyond / seen.sigmas;
  return seen.beyond * slope > tolerance;
}

bool
Judge::supports(const Eigen::Vector3f& place) const
{
  if (!judge_->surface)
    return true;
  const Eigen::Vector3f seen = T_judge_judged_ * place;
  const auto reach = static_cast<float>(kReach * judge_->voxel);
  const Neighbour nearest = judge_->tree->nearest(seen, reach * reach);
  if (nearest.index < 0)
    return false;
  const auto at = static_cast<std::size_t>(nearest.index);
  const Eigen::Vector3f off = seen - (*judge_->surface)[at];
  const Eigen::Vector3f& normal = (*judge_->normals)[at];
  const float own = static_cast<float>(judge_->rays->noise());
  const float sigma = sigmaOf(place, seen);
  const float tolerance = kOnSurfaceSigmas * std::sqrt(sigma * sigma + own * own);
  const float across = normal.isZero() ? off.norm() : std::abs(normal.dot(off));
  return across <= tolerance + kBend * off.norm();
}

Jury::Jury(std::vector<Judge> candidates,
           const SeenScan& judged,
           const Points& places,
           unsigned int num_threads)
: candidates_(std::move(candidates))
, judged_(judged)
, places_(places)
, num_threads_(num_threads)
, votes_(places.size())
{}

void
Jury::ask(const std::vector<std::uint32_t>& which, std::size_t first, std::size_t end)
{
  parallelBlocks(which.size(), kLookedAtOnce, num_threads_, [&](const Block& block) {
    look(which, block.begin, block.end, {first, std::min(end, judges_.size())});
  });
}

/** Whoever tells most of what is least known comes next. */
std::size_t
Jury::choose(const std::vector<std::uint32_t>& which, std::size_t count)
{
  Points sample;
  const std::size_t step = std::max<std::size_t>(1, which.size() / kSample);
  for (std::size_t i = 0; i < which.size(); i += step)
    sample.push_back(places_[which[i]]);
  count = std::min(count, kMostJudges - judges_.size());
  std::vector<std::vector<std::uint8_t>> says(candidates_.size()); // of each place
  parallelFor(candidates_.size(), num_threads_, [&](std::size_t c) {
    for (const SightOfPlace& seen : candidates_[c].look(sample))
      says[c].push_back(
          seen.sight == Sight::kFree || seen.sight == Sight::kConfirmed ? 1 : 0);
  });
  std::vector<double> worth(sample.size(), 1);
  std::vector<Judge> rest;
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
    judges_.push_back(candidates_[best]);
    for (std::size_t p = 0; p < sample.size(); ++p)
      worth[p] /= says[best][p] ? 2 : 1;
  }
  for (std::size_t c = 0; c < candidates_.size(); ++c)
    if (!taken[c])
      rest.push_back(candidates_[c]);
  candidates_ = std::move(rest);
  return judges_.size();
}

void
Jury::look(const std::vector<std::uint32_t>& which,
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
    const auto seen = judges_[j].look(some);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      Votes& vote = votes_[which[begin + k]];
      if (seen[k].sight == Sight::kConfirmed)
        vote.hits = static_cast<std::uint16_t>(vote.hits | bit);
      if (seen[k].sight != Sight::kFree)
        continue;
      if (!is_known[k])
        normals[k] = normalOf(judged_, some[k]);
      is_known[k] = true;
      if (judges_[j].isMiss(seen[k], some[k], normals[k]))
        vote.misses = static_cast<std::uint16_t>(vote.misses | bit);
    }
  }
  for (std::size_t i = begin; i < end; ++i)
    if (votes_[which[i]].misses != 0)
      checkSurfaces(which[i], bench);
}

void
Jury::checkSurfaces(std::size_t place, Bench bench)
{
  Votes& vote = votes_[place];
  for (std::size_t j = bench.first; j < bench.end; ++j) {
    if (!judges_[j].hasSurface())
      continue;
    const unsigned bit = 1U << j;
    const bool on_surface = judges_[j].supports(places_[place]);
    vote.hits =
        static_cast<std::uint16_t>(on_surface ? vote.hits | bit : vote.hits & ~bit);
    if (on_surface)
      vote.misses = static_cast<std::uint16_t>(vote.misses & ~bit);
  }
}

} // namespace pcl6d::moving_objects
