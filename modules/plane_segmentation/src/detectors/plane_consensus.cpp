// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/consensus_scorer.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/plane_consensus.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
constexpr std::size_t kScored = 1024;      // points to score draws on
constexpr std::size_t kPerIteration = 256; // scored points until a bad draw is dropped
/** Per iteration, at least: for few points, these draws cost less than an iteration of
 * PCL. */
constexpr std::size_t kLeastDraws = 8;
constexpr std::size_t kDrawBlock = 64;  // draws of a thread's step
constexpr std::size_t kFirstRound = 16; // draws; each round doubles
constexpr std::size_t kLargestRound = 4096;
constexpr std::size_t kKept = 16;     // best draws of a round that are kept
constexpr std::size_t kTried = 4;     // draws that are fitted, not near a known plane
constexpr std::size_t kFinalists = 8; // largest number of known planes
constexpr std::size_t kFinals = 3;    // known planes that are fitted to every point
/** Largest share that a fit to every point may add to a score. */
constexpr double kGainOfFit = 0.1;
/** [max_distance] Accuracy of a plane found on a sample. */
constexpr double kLastStep = 0.125;
/** Number of PCL's draws at the cost of one pass over the points. */
constexpr std::size_t kDrawsPerLook = 4;
/** For fewer points the sample is sufficient, and a pass costs more than the rest. */
constexpr std::size_t kFewPoints = 16 * kScored, kDrawsPerLookAtFew = 10;
/** Chance that a draw on a plane leads to it; the others are too small for their
 * noise. */
constexpr double kGoodConsensusDraw = 0.25;
constexpr double kGoodBySample = 0.1; // for a sample, which may miss good draws
/** Smallest squared sine between the sides of a draw; less is rounding
 * (PlaneMoments::fit()). */
constexpr float kLeastSquaredSine = 1e-9f;
constexpr double kFinalSigmas = 3; // of a count from the sample, for the last choice

/** Three points, and their plane. */
using ConsensusDraft = ConsensusCandidate;

class ConsensusSearch {
public:
  ConsensusSearch(const ConsensusPoints& all, const PlaneConsensusOptions& options)
  : all_(all)
  , options_(options)
  , rule_(options.direction)
  , some_(all.size() > kScored ? all.sample(kScored, mixBits(options.seed))
                               : ConsensusPoints(0))
  , sample_(all.size() > kScored ? some_ : all)
  , scorer_(sample_, options_, rule_, 1)
  , final_scorer_(all_, options_, rule_, options.num_threads)
  {}

  PlaneConsensus
  run()
  {
    PlaneConsensus result;
    for (std::size_t round = kFirstRound; draws_ < drawsNeeded(); round *= 2)
      tryRound(std::min({round, kLargestRound, drawsNeeded() - draws_}));
    result.draws = draws_;
    result.status = Status::kRankDeficient;
    if (finalists_.empty())
      return result;
    const ConsensusCandidate best = winner();
    auto places = final_scorer_.placesOn(best);
    if (places.size() < 3)
      return result;
    result.status = Status::kOk;
    result.normal = best.fit.normal;
    result.centre = best.fit.centre + all_.origin().cast<double>();
    result.offset = result.normal.dot(result.centre);
    result.inliers = std::move(places);
    result.sample = best.sample;
    return result;
  }

private:
  /** \return the number of draws for the given probability, within the effort */
  std::size_t
  drawsNeeded() const
  {
    const std::size_t runs = std::max(kLeastDraws, all_.size() / kPerIteration);
    const auto effort = static_cast<double>(options_.max_iterations) *
                        static_cast<double>(options_.neighbours ? 1 : runs);
    if (finalists_.empty())
      return clampedTo<std::size_t>(effort);
    if (scorer_.isPerfect(finalists_.front().score))
      return draws_;
    const double share = best_share_;
    const double good = &sample_ == &all_ ? kGoodConsensusDraw : kGoodBySample;
    const double chance = good * share * share * share;
    const double missed = 1 - options_.probability;
    if (!(missed > 0 && chance > 0))
      return clampedTo<std::size_t>(effort);
    const double needed = portableLog(missed) / portableLog(1 - chance);
    return clampedTo<std::size_t>(std::max(1.0, std::min(needed + 1, effort)));
  }

  /** \return a number below a size */
  std::size_t
  drawBelow(std::size_t size, std::uint64_t key) const
  {
    return ((mixBits(mixBits(options_.seed) ^ key) >> 32) * size) >> 32;
  }

  std::optional<ConsensusDraft>
  draftOf(const ConsensusPoints& points, const std::array<std::size_t, 3>& slots) const
  {
    const Eigen::Vector3d p = points.point(slots[0]).cast<double>();
    const Eigen::Vector3d a = points.point(slots[1]).cast<double>() - p;
    const Eigen::Vector3d b = points.point(slots[2]).cast<double>() - p;
    ConsensusDraft draft;
    draft.fit.normal = a.cross(b);
    const double square = draft.fit.normal.squaredNorm();
    const double sides = a.squaredNorm() * b.squaredNorm();
    if (!(square > static_cast<double>(kLeastSquaredSine) * sides))
      return {};
    draft.fit.normal /= std::sqrt(square);
    draft.fit.centre = p + (a + b) / 3;
    draft.fit.offset = draft.fit.normal.dot(draft.fit.centre);
    rule_.apply(draft.fit);
    draft.plane = {draft.fit.normal.cast<float>(),
                   static_cast<float>(draft.fit.offset)};
    for (std::size_t k = 0; k < 3; ++k)
      draft.sample[k] = points.place(slots[k]);
    return draft;
  }

  /** \return a draw from the sample */
  std::optional<ConsensusDraft>
  drawAny(std::uint64_t number) const
  {
    const std::size_t size = sample_.size();
    std::array<std::size_t, 3> slots{};
    slots[0] = drawBelow(size, 4 * number);
    slots[1] = (slots[0] + 1 + drawBelow(size - 1, 4 * number + 1)) % size;
    slots[2] = drawBelow(size - 2, 4 * number + 2);
    // The third is one of the remaining points.
    const auto [low, high] = std::minmax(slots[0], slots[1]);
    slots[2] += static_cast<std::size_t>(slots[2] >= low);
    slots[2] += static_cast<std::size_t>(slots[2] >= high);
    return draftOf(sample_, slots);
  }

  /** \return a draw of points near each other */
  std::optional<ConsensusDraft>
  drawNear(std::uint64_t number) const
  {
    const std::size_t first = drawBelow(all_.size(), 4 * number);
    std::vector<std::uint32_t> near;
    options_.neighbours(all_.place(first), near);
    std::vector<std::size_t> slots;
    for (const auto place : near)
      if (const auto slot = all_.find(place); slot && *slot != first)
        slots.push_back(*slot);
    if (slots.size() < 2)
      return {};
    const std::size_t second = drawBelow(slots.size(), 4 * number + 1);
    const std::size_t third = second + 1 + drawBelow(slots.size() - 1, 4 * number + 2);
    return draftOf(all_, {first, slots[second], slots[third % slots.size()]});
  }

  /** \return the best draws of a block, scored, best first */
  std::vector<ConsensusDraft>
  bestOf(const Block& block) const
  {
    std::vector<ConsensusDraft> best;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      auto draft = options_.neighbours ? drawNear(draws_ + i) : drawAny(draws_ + i);
      if (!draft)
        continue;
      const double floor = best.size() < kKept ? -1 : best.back().score;
      draft->score = scorer_.scoreAbove(draft->plane, floor);
      keepBest(best, *draft, kKept);
    }
    return best;
  }

  static void
  keepBest(std::vector<ConsensusDraft>& best,
           const ConsensusDraft& draft,
           std::size_t count)
  {
    if (best.size() == count && !(draft.score > best.back().score))
      return;
    const auto place =
        std::upper_bound(best.begin(),
                         best.end(),
                         draft,
                         [](const ConsensusDraft& a, const ConsensusDraft& b) {
                           return a.score > b.score;
                         });
    best.insert(place, draft);
    if (best.size() > count)
      best.pop_back();
  }

  void
  tryRound(std::size_t count)
  {
    std::vector<std::vector<ConsensusDraft>> blocks((count + kDrawBlock - 1) /
                                                    kDrawBlock);
    const unsigned int num_threads = options_.neighbours ? 1 : options_.num_threads;
    parallelBlocks(count, kDrawBlock, num_threads, [&](const Block& block) {
      blocks[block.index] = bestOf(block);
    });
    draws_ += count;
    std::vector<ConsensusDraft> best;
    for (const auto& block : blocks)
      for (const auto& draft : block)
        keepBest(best, draft, kKept);
    std::size_t tried = 0;
    const std::size_t most = std::clamp<std::size_t>(count / kFirstRound, 1, kTried);
    for (const auto& draft : best)
      if (tried < most && !isKnown(draft)) {
        addFinalist(scorer_.improved(draft, false));
        ++tried;
      }
  }

  /** \return whether a draw is near a better plane */
  bool
  isKnown(const ConsensusDraft& draft) const
  {
    return std::any_of(finalists_.begin(), finalists_.end(), [&](const auto& known) {
      return known.score >= draft.score && areSame(known, draft);
    });
  }

  /** Whether two planes are equal where their points are. */
  bool
  areSame(const ConsensusCandidate& a, const ConsensusCandidate& b) const
  {
    const double limit = options_.max_distance;
    const double sine = a.fit.normal.cross(b.fit.normal).norm();
    return std::abs(a.fit.distance(b.fit.centre)) < limit && sine * a.reach < limit;
  }

  void
  addFinalist(const ConsensusCandidate& candidate)
  {
    for (auto& known : finalists_)
      if (areSame(known, candidate)) {
        if (candidate.score > known.score)
          known = candidate;
        std::sort(finalists_.begin(), finalists_.end(), isBetter);
        updateShare();
        return;
      }
    keepBest(finalists_, candidate, kFinalists);
    updateShare();
  }

  static bool
  isBetter(const ConsensusCandidate& a, const ConsensusCandidate& b)
  {
    return a.score > b.score;
  }

  void
  updateShare()
  {
    best_share_ = static_cast<double>(scorer_.countOn(finalists_.front())) /
                  static_cast<double>(sample_.size());
  }

  /** \return whether a finalist may have more points than the first on the whole */
  bool
  mayWin(const ConsensusCandidate& candidate) const
  {
    const double best = finalists_.front().score;
    if (sample_.size() == all_.size() || best < 0)
      return candidate.score >= best;
    return best - candidate.score <= kFinalSigmas * std::sqrt(best + candidate.score);
  }

  /** \return the best of the finalists on every point */
  ConsensusCandidate
  winner() const
  {
    std::vector<ConsensusCandidate> finals;
    for (const auto& finalist : finalists_)
      if (mayWin(finalist)) {
        auto climbed = scorer_.climbed(finalist, Climb(), false);
        climbed.score = final_scorer_.score(climbed.plane);
        keepBest(finals, climbed, kFinals);
      }
    std::optional<ConsensusCandidate> best;
    for (const auto& candidate : finals) {
      if (best &&
          candidate.score + kGainOfFit * std::abs(candidate.score) < best->score)
        break;
      const auto improved = final_scorer_.improved(candidate, options_.refine);
      if (!best || improved.score > best->score)
        best = improved;
    }
    if (&sample_ == &all_)
      return *best;
    Climb last;
    last.step = kLastStep;
    last.halvings = 2;
    const std::size_t per_look =
        all_.size() < kFewPoints ? kDrawsPerLookAtFew : kDrawsPerLook;
    last.max_looks = std::min(draws_ / per_look, options_.max_iterations);
    const auto climbed = final_scorer_.climbed(*best, last, options_.refine);
    return climbed.score > best->score ? climbed : *best;
  }

  const ConsensusPoints& all_;
  const PlaneConsensusOptions& options_;
  const DirectionRule rule_;
  const ConsensusPoints some_;
  const ConsensusPoints& sample_; // in random order, or every point if they are few
  const ConsensusScorer scorer_;  // by the sample
  const ConsensusScorer final_scorer_;        // by all points
  std::vector<ConsensusCandidate> finalists_; // best first
  double best_share_ = 0;                     // of the sample on the first
  std::size_t draws_ = 0;
};
} // namespace

void
PlaneConsensusOptions::validate() const
{
  constexpr double kRightAngle = 1.5707963267948966;
  require(max_distance > 0 && std::isfinite(max_distance),
          "max_distance",
          max_distance,
          "> 0 and finite");
  require(
      probability >= 0 && probability <= 1, "probability", probability, "in [0, 1]");
  require(max_iterations >= 1, "max_iterations", max_iterations, ">= 1");
  if (!direction)
    return;
  require(direction->axis.allFinite() && direction->axis.norm() > 0,
          "axis",
          direction->axis.transpose(),
          "finite and not zero");
  require(direction->least >= 0, "least angle", direction->least, ">= 0");
  require(direction->most >= direction->least && direction->most <= kRightAngle,
          "most angle",
          direction->most,
          "from the least angle to pi/2");
}

PlaneConsensus
findPlaneConsensus(ConsensusPoints points, const PlaneConsensusOptions& options)
{
  options.validate();
  if (points.size() < 3)
    return {};
  points.centre();
  return ConsensusSearch(points, options).run();
}

} // namespace pcl6d
