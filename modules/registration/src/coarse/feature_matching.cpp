// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/feature_matching.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/simd_clones.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kLanes = 16;
constexpr std::size_t kMatchedBlock = 64;

/** Features side by side, kLanes at a time, for comparing a feature with many at once.
 */
struct FeatureTable {
  std::size_t size = 0;
  std::vector<float> lanes; ///< [group][bin][lane]

  explicit FeatureTable(const std::vector<Fpfh>& features)
  : size(features.size())
  , lanes((size + kLanes - 1) / kLanes * kLanes * kFpfhSize,
          std::numeric_limits<float>::infinity())
  {
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t bin = 0; bin < kFpfhSize; ++bin)
        lanes[(i / kLanes * kFpfhSize + bin) * kLanes + i % kLanes] = features[i][bin];
  }
};

/** The two smallest distances of a feature to the features of a table. */
struct Nearest {
  int index = -1;
  float best = std::numeric_limits<float>::infinity();
  float second = std::numeric_limits<float>::infinity();
};

/** Sums of each lane run over the bins in order: bit-identical at any vector width.
 * \return whether a sum is below the limit */
PCL6D_SIMD_CLONES bool
distancesToGroup(const float* group, const float* feature, float limit, float* sums)
{
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    sums[lane] = 0;
  for (std::size_t bin = 0; bin < kFpfhSize; ++bin)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float d = group[bin * kLanes + lane] - feature[bin];
      sums[lane] += d * d;
    }
  int below = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    below += sums[lane] < limit ? 1 : 0;
  return below > 0;
}

Nearest
findNearest(const FeatureTable& table, const Fpfh& feature)
{
  Nearest found;
  float sums[kLanes];
  for (std::size_t begin = 0; begin < table.size; begin += kLanes) {
    const float* group = &table.lanes[begin * kFpfhSize];
    if (!distancesToGroup(group, feature.data(), found.second, sums))
      continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (sums[lane] < found.best) {
        found.second = found.best;
        found.best = sums[lane];
        found.index = static_cast<int>(begin + lane);
      }
      else if (sums[lane] < found.second)
        found.second = sums[lane];
    }
  }
  return found;
}

std::vector<Nearest>
findAll(const std::vector<Fpfh>& in,
        const std::vector<Fpfh>& of,
        unsigned int num_threads)
{
  const FeatureTable table(in);
  std::vector<Nearest> found(of.size());
  parallelBlocks(of.size(), kMatchedBlock, num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      found[i] = findNearest(table, of[i]);
  });
  return found;
}
} // namespace

std::vector<FeatureMatch>
matchFeatures(const std::vector<Fpfh>& target,
              const std::vector<Fpfh>& source,
              std::size_t max_matches,
              unsigned int num_threads)
{
  const auto of_source = findAll(target, source, num_threads);
  const auto of_target = findAll(source, target, num_threads);
  struct Candidate {
    float ratio;
    FeatureMatch match;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const auto& n = of_source[i];
    if (source[i] == Fpfh{}) // no description
      continue;
    if (n.index >= 0 && of_target[n.index].index == static_cast<int>(i))
      candidates.push_back(
          {n.second > 0 ? n.best / n.second : 1.f, {static_cast<int>(i), n.index}});
  }
  std::stable_sort(candidates.begin(),
                   candidates.end(),
                   [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  candidates.resize(std::min(candidates.size(), max_matches));
  std::vector<FeatureMatch> matches;
  for (const auto& c : candidates)
    matches.push_back(c.match);
  return matches;
}

} // namespace pcl6d::registration
