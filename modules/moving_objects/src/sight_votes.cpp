// SPDX-License-Identifier: BSD-3-Clause
#include "sight_votes.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
constexpr std::size_t kLookedAtOnce = 2048;

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
  const Eigen::Vector3f ray =
      T_judge_judged_ * place - judge_->rays->origin();
  const float slope = std::abs((T_judge_judged_.linear() * normal).dot(ray.normalized()));
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

std::vector<Judge>
chooseJudges(const std::vector<Judge>& candidates,
             const Points& sample,
             std::size_t count)
{
  std::vector<std::vector<std::uint8_t>> says; // per candidate and place
  for (const Judge& candidate : candidates) {
    says.emplace_back();
    for (const SightOfPlace& seen : candidate.look(sample))
      says.back().push_back(
          seen.sight == Sight::kFree || seen.sight == Sight::kConfirmed ? 1 : 0);
  }
  // Whoever tells most of what is least known comes next.
  std::vector<double> worth(sample.size(), 1);
  std::vector<bool> taken(candidates.size(), false);
  std::vector<Judge> judges;
  while (judges.size() < count) {
    std::size_t best = candidates.size();
    double most = 0;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      double sum = 0;
      for (std::size_t p = 0; !taken[c] && p < sample.size(); ++p)
        sum += says[c][p] * worth[p];
      if (sum > most) {
        most = sum;
        best = c;
      }
    }
    if (best == candidates.size())
      break;
    taken[best] = true;
    judges.push_back(candidates[best]);
    for (std::size_t p = 0; p < sample.size(); ++p)
      if (says[best][p])
        worth[p] /= 2;
  }
  return judges;
}

std::vector<Votes>
votesOf(const std::vector<Judge>& judges,
        const SeenScan& judged,
        const Points& places,
        unsigned int num_threads)
{
  std::vector<Votes> votes(places.size());
  parallelBlocks(places.size(), kLookedAtOnce, num_threads, [&](const Block& block) {
    const Points some(places.begin() + static_cast<std::ptrdiff_t>(block.begin),
                      places.begin() + static_cast<std::ptrdiff_t>(block.end));
    std::vector<Eigen::Vector3f> normals(some.size());
    for (std::size_t j = 0; j < judges.size(); ++j) {
      const auto bit = static_cast<std::uint16_t>(1U << j);
      const auto seen = judges[j].look(some);
      for (std::size_t k = 0; k < seen.size(); ++k) {
        Votes& vote = votes[block.begin + k];
        if (seen[k].sight == Sight::kFree) {
          if (vote.misses == 0)
            normals[k] = normalOf(judged, some[k]);
          if (judges[j].isMiss(seen[k], some[k], normals[k]))
          vote.misses = static_cast<std::uint16_t>(vote.misses | bit);
        }
        else if (seen[k].sight == Sight::kConfirmed)
          vote.hits = static_cast<std::uint16_t>(vote.hits | bit);
      }
    }
    for (std::size_t k = 0; k < some.size(); ++k) {
      Votes& vote = votes[block.begin + k];
      if (vote.misses == 0)
        continue;
      for (std::size_t j = 0; j < judges.size(); ++j) {
        if (!judges[j].hasSurface())
          continue;
        const unsigned bit = 1U << j;
        const bool on_surface = judges[j].supports(some[k]);
        vote.hits = static_cast<std::uint16_t>(on_surface ? vote.hits | bit
                                                          : vote.hits & ~bit);
        if (on_surface)
          vote.misses = static_cast<std::uint16_t>(vote.misses & ~bit);
      }
    }
  });
  return votes;
}

} // namespace pcl6d::moving_objects
