// SPDX-License-Identifier: BSD-3-Clause
#include "features/compatibility_graph.h"

#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/compatible_pairs.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace global_registration;

namespace {
/** The most pairs: their square of bits takes 110 MB. */
constexpr std::size_t kMostPairs = 30000;

/** Tests whether two pairs can be right together. */
class Agreement {
public:
  Agreement(const Points& source, const Points& target, double noise)
  : source_(source), target_(target), tolerance_(2 * noise)
  {}

  bool
  operator()(std::size_t a, std::size_t b) const
  {
    return std::abs(lengthOf(source_[a], source_[b]) -
                    lengthOf(target_[a], target_[b])) <= tolerance_;
  }

private:
  static double
  lengthOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
  {
    return (a.cast<double>() - b.cast<double>()).norm();
  }

  const Points& source_;
  const Points& target_;
  double tolerance_; // [m]
};

std::vector<std::size_t>
finitePairs(const Points& source, const Points& target)
{
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < source.size(); ++i)
    if (source[i].allFinite() && target[i].allFinite())
      finite.push_back(i);
  return finite;
}

/** An even selection of pairs. */
std::vector<std::size_t>
sampleOf(const std::vector<std::size_t>& all, std::size_t most)
{
  if (all.size() <= most)
    return all;
  std::vector<std::size_t> sample;
  for (std::size_t k = 0; k < most; ++k)
    sample.push_back(all[k * all.size() / most]);
  return sample;
}
} // namespace

void
CompatibilityOptions::validate() const
{
  require(std::isfinite(noise) && noise > 0, "noise", noise, "finite and > 0");
  require(max_pairs >= 3 && max_pairs <= kMostPairs,
          "max_pairs",
          max_pairs,
          "in [3, 30000]");
}

std::vector<std::size_t>
compatiblePairs(const Points& source,
                const Points& target,
                const CompatibilityOptions& options)
{
  options.validate();
  require(source.size() == target.size(),
          "points of the target",
          target.size(),
          "the number of source points, " + std::to_string(source.size()));
  const Agreement agree(source, target, options.noise);
  const std::vector<std::size_t> all = finitePairs(source, target);
  const std::vector<std::size_t> looked_at = sampleOf(all, options.max_pairs);
  const CompatibilityGraph graph(
      looked_at.size(),
      [&](std::size_t a, std::size_t b) { return agree(looked_at[a], looked_at[b]); },
      options.num_threads);
  std::vector<std::size_t> kept;
  for (const auto place : graph.largestClique())
    kept.push_back(looked_at[place]);
  if (looked_at.size() == all.size())
    return kept;
  std::vector<bool> is_known(source.size(), false);
  for (const std::size_t i : looked_at)
    is_known[i] = true;
  for (const std::size_t i : all)
    if (!is_known[i] && std::all_of(kept.begin(), kept.end(), [&](std::size_t other) {
          return agree(i, other);
        }))
      kept.push_back(i);
  std::sort(kept.begin(), kept.end());
  return kept;
}

} // namespace pcl6d
