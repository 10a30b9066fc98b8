// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/consensus_scorer.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

namespace pcl6d::plane_segmentation {

namespace {
constexpr std::size_t kEvaluatedBlock = 16 * kConsensusRun; // points of a thread's step
constexpr std::size_t kPretest = 256; // points after which a draw may be dropped
/** [sigma] of a count from a sample: one draw in a thousand is dropped in error. */
constexpr double kPretestSigmas = 3;
constexpr int kMaxEvaluatedFits = 5;
/** [rad] Margin of a normal inside its limit, for rounding in floats. */
constexpr double kInside = 1e-6;
/** Ratio of the standard deviation to the median of normal errors, and limit of
 * inliers. */
constexpr double kSigmaOfMedian = 1.4826, kInlierSigmas = 2.5; // Rousseeuw, Leroy 1987

ConsensusCandidate
candidateOf(const PlaneFit& fit, const ConsensusCandidate& from)
{
  ConsensusCandidate candidate = from;
  candidate.fit = fit;
  candidate.plane = {fit.normal.cast<float>(), static_cast<float>(fit.offset)};
  return candidate;
}
} // namespace

DirectionRule::DirectionRule(const std::optional<DirectionLimit>& limit)
{
  if (!limit)
    return;
  active_ = true;
  axis_ = limit->axis.normalized();
  const double inside = std::min(kInside, (limit->most - limit->least) / 4);
  least_ = limit->least + inside;
  most_ = limit->most - inside;
  cosine_of_least_ = portableSinCos(least_).cos;
  cosine_of_most_ = portableSinCos(most_).cos;
  if (limit->least <= 0)
    cosine_of_least_ = 1; // no lower limit
  if (limit->most >= M_PI / 2)
    cosine_of_most_ = 0;
}

void
DirectionRule::apply(PlaneFit& plane) const
{
  if (!active_)
    return;
  const double along = plane.normal.dot(axis_);
  const bool too_far = std::abs(along) < cosine_of_most_;
  if (!too_far && !(std::abs(along) > cosine_of_least_))
    return;
  Eigen::Vector3d aside = plane.normal - along * axis_;
  const double length = aside.norm();
  aside = length > 0 ? Eigen::Vector3d(aside / length) : axis_.unitOrthogonal();
  const SinCos angle = portableSinCos(too_far ? most_ : least_);
  plane.normal = ((along < 0 ? -angle.cos : angle.cos) * axis_ + angle.sin * aside);
  plane.normal.normalize();
  plane.offset = plane.normal.dot(plane.centre);
}

ConsensusScorer::ConsensusScorer(const ConsensusPoints& points,
                                 const PlaneConsensusOptions& options,
                                 const DirectionRule& rule,
                                 unsigned int num_threads)
: points_(points), options_(options), rule_(rule), num_threads_(num_threads)
{}

/** \return of(begin, size, distances) of each block, summed over its runs in order */
template <typename Value, typename Of>
std::vector<Value>
ConsensusScorer::overBlocks(const LocalPlane& plane, Of&& of) const
{
  std::vector<Value> values((points_.size() + kEvaluatedBlock - 1) / kEvaluatedBlock);
  const auto scoreBlock = [&](const Block& block) {
    float distances[kConsensusRun];
    for (std::size_t i = block.begin; i < block.end; i += kConsensusRun) {
      const std::size_t size = std::min(kConsensusRun, block.end - i);
      consensusDistances(points_, i, size, plane, distances);
      of(values[block.index], i, size, distances);
    }
  };
  if (values.size() == 1)
    scoreBlock({0, 0, points_.size()});
  else
    parallelBlocks(points_.size(), kEvaluatedBlock, num_threads_, scoreBlock);
  return values;
}

double
ConsensusScorer::medianTo(const LocalPlane& plane) const
{
  std::vector<float> all(points_.size());
  overBlocks<char>(plane, [&](char&, std::size_t i, std::size_t size, const float* d) {
    std::copy(d, d + size, all.begin() + static_cast<std::ptrdiff_t>(i));
  });
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

double
ConsensusScorer::score(const LocalPlane& plane) const
{
  if (options_.criterion == ConsensusCriterion::kLeastMedian)
    return -medianTo(plane);
  const auto limit = static_cast<float>(options_.max_distance);
  const bool squares = options_.criterion == ConsensusCriterion::kTruncatedSquares;
  return mergeTree(overBlocks<double>(
                       plane,
                       [&](double& sum, std::size_t, std::size_t size, const float* d) {
                         sum += squares
                                    ? gainBelow(d, size, limit)
                                    : static_cast<double>(countBelow(d, size, limit));
                       }),
                   std::plus<double>());
}

double
ConsensusScorer::scoreAbove(const LocalPlane& plane, double floor) const
{
  const std::size_t all = points_.size(), first = std::min(all, kPretest);
  if (first == all || options_.criterion == ConsensusCriterion::kLeastMedian)
    return score(plane);
  const auto limit = static_cast<float>(options_.max_distance);
  const bool squares = options_.criterion == ConsensusCriterion::kTruncatedSquares;
  float distances[kConsensusRun];
  double sum = 0;
  for (std::size_t i = 0; i < all;) {
    const std::size_t size = i == 0 ? first : std::min(kConsensusRun, all - i);
    consensusDistances(points_, i, size, plane, distances);
    sum += squares ? gainBelow(distances, size, limit)
                   : static_cast<double>(countBelow(distances, size, limit));
    i += size;
    if (i == first) {
      const auto tested = static_cast<double>(first);
      const double spread = std::sqrt(sum * (1 - sum / tested) + 1);
      if ((sum + kPretestSigmas * spread) * static_cast<double>(all) < floor * tested)
        return -1;
    }
  }
  return sum;
}

double
ConsensusScorer::fitLimit(double score) const
{
  if (options_.criterion != ConsensusCriterion::kLeastMedian)
    return options_.max_distance;
  const auto size = static_cast<double>(points_.size());
  const double small_sample = 1 + 5 / std::max(1.0, size - 3);
  const double sigma = kSigmaOfMedian * small_sample * -score;
  // Every point on one plane: keep a margin against rounding.
  return std::max(kInlierSigmas * sigma, 1e-6 * options_.max_distance);
}

PlaneMoments
ConsensusScorer::momentsOf(const LocalPlane& plane, double limit) const
{
  const auto blocks = overBlocks<PlaneMoments>(
      plane, [&](PlaneMoments& sums, std::size_t i, std::size_t size, const float* d) {
        sums.add(momentsBelow(points_, i, size, d, static_cast<float>(limit)));
      });
  return mergeTree(blocks, [](PlaneMoments a, const PlaneMoments& b) {
    a.add(b);
    return a;
  });
}

std::size_t
ConsensusScorer::countOn(const ConsensusCandidate& candidate) const
{
  const auto limit = static_cast<float>(fitLimit(candidate.score));
  return mergeTree(
      overBlocks<std::size_t>(
          candidate.plane,
          [&](std::size_t& sum, std::size_t, std::size_t size, const float* d) {
            sum += countBelow(d, size, limit);
          }),
      std::plus<std::size_t>());
}

bool
ConsensusScorer::isPerfect(double score) const
{
  return options_.criterion == ConsensusCriterion::kLeastMedian
             ? score >= 0
             : score >= static_cast<double>(points_.size());
}

std::optional<ConsensusCandidate>
ConsensusScorer::fitted(const ConsensusCandidate& to) const
{
  const PlaneMoments sums = momentsOf(to.plane, fitLimit(to.score));
  auto fit = sums.fit();
  if (!fit)
    return {};
  rule_.apply(*fit);
  ConsensusCandidate result = candidateOf(*fit, to);
  result.reach = std::sqrt(sums.scatter().trace() / static_cast<double>(sums.count()));
  return result;
}

ConsensusCandidate
ConsensusScorer::improved(ConsensusCandidate start, bool only_fits) const
{
  start.score = score(start.plane);
  ConsensusCandidate last = start, best = start;
  for (int i = 0; i < kMaxEvaluatedFits; ++i) {
    const auto fit = fitted(last);
    if (!fit)
      break;
    last = *fit;
    last.score = score(last.plane);
    const bool better = last.score > best.score;
    if (better || (only_fits && i == 0))
      best = last;
    else if (best.reach == 0)
      best.reach = last.reach;
    if ((!better && i > 0) || isPerfect(last.score))
      break;
  }
  return best;
}

ConsensusCandidate
ConsensusScorer::evaluated(const ConsensusCandidate& from,
                           const PlaneFit& plane,
                           bool only_fits) const
{
  ConsensusCandidate candidate = candidateOf(plane, from);
  if (options_.criterion == ConsensusCriterion::kLeastMedian || !only_fits)
    candidate.score = score(candidate.plane);
  if (!only_fits)
    return candidate;
  if (auto fit = fitted(candidate)) {
    fit->score = score(fit->plane);
    return *fit;
  }
  return candidate;
}

ConsensusCandidate
ConsensusScorer::climbed(const ConsensusCandidate& start,
                         const Climb& climb,
                         bool only_fits) const
{
  ConsensusCandidate best = evaluated(start, start.fit, only_fits);
  PlaneFit place = start.fit; // the plane whose candidate, or fit, is `best`
  double step = climb.step * options_.max_distance;
  std::size_t looks = 0;
  for (int halvings = 0; halvings <= climb.halvings && !isPerfect(best.score);) {
    const PlaneFit from = place;
    const Eigen::Vector3d u = from.normal.unitOrthogonal(), v = from.normal.cross(u);
    bool better = false;
    for (int way = 0; way < 6; ++way) {
      if (looks++ == climb.max_looks)
        return best;
      const double move = way % 2 == 0 ? step : -step;
      PlaneFit next = from;
      if (way < 2)
        next.centre += move * next.normal;
      else if (start.reach > 0)
        next.normal =
            (next.normal + move / start.reach * (way < 4 ? u : v)).normalized();
      next.offset = next.normal.dot(next.centre);
      rule_.apply(next);
      const ConsensusCandidate candidate = evaluated(best, next, only_fits);
      if (candidate.score > best.score) {
        best = candidate;
        place = next;
        better = true;
      }
    }
    if (!better) {
      step /= 2;
      ++halvings;
    }
  }
  return best;
}

std::vector<std::uint32_t>
ConsensusScorer::placesOn(const ConsensusCandidate& candidate) const
{
  std::vector<std::uint32_t> places(points_.size() + 1);
  const auto limit = static_cast<float>(options_.max_distance);
  float distances[kConsensusRun];
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); i += kConsensusRun) {
    const std::size_t size = std::min(kConsensusRun, points_.size() - i);
    consensusDistances(points_, i, size, candidate.plane, distances);
    count += placesBelow(points_, i, size, distances, limit, places.data() + count);
  }
  places.resize(count);
  return places;
}

} // namespace pcl6d::plane_segmentation
