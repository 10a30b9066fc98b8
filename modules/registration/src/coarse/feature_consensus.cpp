// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/feature_consensus.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kBlockSize = 64;
constexpr int kTries = 8; // draws, of which the best connected match is taken
constexpr double kMaxCosineGap = 0.35;

using Word = std::uint64_t;
using Bits = std::vector<Word>;

/** Places of both points of a match, in double. */
struct Pair {
  Eigen::Vector3d source, target;
};

/** Compatibility of pairs of matches, a row of bits per match. */
class Compatibility {
public:
  Compatibility(const FeatureScan& target,
                const FeatureScan& source,
                const std::vector<FeatureMatch>& matches,
                const ConsensusOptions& options)
  : size_(matches.size()), words_((size_ + 63) / 64), bits_(size_ * words_, 0)
  {
    parallelBlocks(size_, kBlockSize, options.num_threads, [&](const Block& block) {
      for (std::size_t i = block.begin; i < block.end; ++i)
        for (std::size_t j = 0; j < size_; ++j)
          if (agree(target, source, matches[i], matches[j], options))
            bits_[i * words_ + j / 64] |= Word{1} << (j % 64);
    });
  }

  Bits
  row(std::size_t i) const
  {
    return Bits(bits_.begin() + i * words_, bits_.begin() + (i + 1) * words_);
  }

  Bits
  common(Bits set, std::size_t i) const
  {
    for (std::size_t w = 0; w < words_; ++w)
      set[w] &= bits_[i * words_ + w];
    return set;
  }

private:
  static bool
  agree(const FeatureScan& target,
        const FeatureScan& source,
        const FeatureMatch& a,
        const FeatureMatch& b,
        const ConsensusOptions& options)
  {
    const float in_source = (source.points[a.source] - source.points[b.source]).norm();
    const float in_target = (target.points[a.target] - target.points[b.target]).norm();
    if (std::min(in_source, in_target) < options.min_length ||
        std::abs(in_source - in_target) > options.tolerance)
      return false;
    const float cosine_source = source.normals[a.source].dot(source.normals[b.source]);
    const float cosine_target = target.normals[a.target].dot(target.normals[b.target]);
    return std::abs(cosine_source - cosine_target) < kMaxCosineGap;
  }

  std::size_t size_;
  std::size_t words_;
  Bits bits_;
};

std::size_t
countOf(const Bits& bits)
{
  std::size_t count = 0;
  for (const Word word : bits)
    count += static_cast<std::size_t>(__builtin_popcountll(word));
  return count;
}

/** \return the place of the n-th set bit; more than n bits must be set */
std::size_t
nthOf(const Bits& bits, std::size_t n)
{
  std::size_t w = 0;
  for (;; ++w) {
    const auto count = static_cast<std::size_t>(__builtin_popcountll(bits[w]));
    if (n < count)
      break;
    n -= count;
  }
  Word word = bits[w];
  for (; n > 0; --n)
    word &= word - 1;
  return 64 * w + static_cast<std::size_t>(__builtin_ctzll(word));
}

std::size_t
drawBelow(Random& random, std::size_t count)
{
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

/** Draws a match of the set, the best connected of a few tries, and reduces the set to
 * the matches compatible with the drawn match. \return empty if the set is empty */
std::optional<std::size_t>
drawConnected(const Compatibility& graph, Bits& set, Random& random)
{
  const std::size_t size = countOf(set);
  std::optional<std::size_t> best;
  std::size_t best_count = 0;
  Bits best_set;
  for (int i = 0; i < kTries && size > 0; ++i) {
    const std::size_t candidate = nthOf(set, drawBelow(random, size));
    Bits rest = graph.common(set, candidate);
    const std::size_t count = countOf(rest);
    if (!best || count > best_count) {
      best = candidate;
      best_count = count;
      best_set = std::move(rest);
    }
  }
  if (best)
    set = std::move(best_set);
  return best;
}

/** The least-squares motion of the pairs within the tolerance at a given motion. */
struct Fit {
  RigidEstimate estimate;
  std::size_t count = 0;
};

Fit
refit(const std::vector<Pair>& pairs, const Eigen::Isometry3d& T, double tolerance)
{
  PairAccumulator agreeing;
  Fit fit;
  for (const auto& pair : pairs)
    if ((T * pair.source - pair.target).squaredNorm() <= tolerance * tolerance) {
      agreeing.add(pair.source, pair.target);
      ++fit.count;
    }
  fit.estimate = minimiseByQuaternion(agreeing.sums());
  return fit;
}

std::optional<Hypothesis>
drawHypothesis(const std::vector<Pair>& pairs,
               const Compatibility& graph,
               double tolerance,
               Random& random)
{
  const std::size_t first = drawBelow(random, pairs.size());
  Bits set = graph.row(first);
  PairAccumulator triple;
  triple.add(pairs[first].source, pairs[first].target);
  for (int i = 0; i < 2; ++i) {
    const auto next = drawConnected(graph, set, random);
    if (!next)
      return std::nullopt;
    triple.add(pairs[*next].source, pairs[*next].target);
  }
  const RigidEstimate start = minimiseByQuaternion(triple.sums());
  if (start.status != Status::kOk)
    return std::nullopt;
  Hypothesis found{start.transform, 0};
  for (int i = 0; i < 3; ++i) {
    const Fit fit = refit(pairs, found.T_target_source, tolerance);
    if (fit.estimate.status != Status::kOk ||
        static_cast<double>(fit.count) <= found.score)
      break;
    found = {fit.estimate.transform, static_cast<double>(fit.count)};
  }
  return found.score > 3 ? std::optional<Hypothesis>(found) : std::nullopt;
}
} // namespace

std::vector<Hypothesis>
keepDistinct(std::vector<Hypothesis> hypotheses,
             const PlacementDistance& distance,
             double min_distance,
             std::size_t max_count)
{
  std::stable_sort(hypotheses.begin(),
                   hypotheses.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return firstDistinct(hypotheses, distance, min_distance, max_count);
}

std::vector<Hypothesis>
drawHypotheses(const FeatureScan& target,
               const FeatureScan& source,
               const std::vector<FeatureMatch>& matches,
               const ConsensusOptions& options)
{
  if (matches.size() < 3)
    return {};
  std::vector<Pair> pairs;
  for (const auto& match : matches)
    pairs.push_back({source.points[match.source].cast<double>(),
                     target.points[match.target].cast<double>()});
  const Compatibility graph(target, source, matches, options);
  std::vector<std::optional<Hypothesis>> drawn(options.draws);
  parallelBlocks(
      options.draws, kBlockSize, options.num_threads, [&](const Block& block) {
        for (std::size_t i = block.begin; i < block.end; ++i) {
          Random random(mixBits(options.seed ^ mixBits(i)));
          drawn[i] = drawHypothesis(pairs, graph, options.tolerance, random);
        }
      });
  std::vector<Hypothesis> hypotheses;
  for (const auto& h : drawn)
    if (h)
      hypotheses.push_back(*h);
  return hypotheses;
}

} // namespace pcl6d::registration
