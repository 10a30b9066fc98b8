// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/pose_pairs.h"

#include <pcl6d/benchmarking/length_ratio.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace benchmarking;

LengthRatioErrors
lengthRatioErrors(const std::vector<LengthPair>& lengths)
{
  std::vector<double> scales, errors;
  for (const auto& length : lengths) {
    for (const double value : {length.estimate, length.reference})
      require(std::isfinite(value) && value > 0, "length", value, "finite and > 0");
    scales.push_back(length.estimate / length.reference);
  }
  for (std::size_t k = 0; k < scales.size(); ++k)
    for (std::size_t l = k + 1; l < scales.size(); ++l)
      errors.push_back(std::abs(scales[k] / scales[l] - 1));
  LengthRatioErrors result;
  result.ratio = errorStatistics(errors);
  if (!scales.empty())
    result.scale = errorStatistics(scales).median;
  return result;
}

std::vector<LengthPair>
poseDistances(const Trajectory& estimate,
              const Trajectory& reference,
              const std::vector<PosePair>& pairs)
{
  checkPairs(estimate, reference, pairs);
  constexpr std::size_t kPoses = 16;
  constexpr double kShort = 0.1; // of the longest
  const std::size_t count = std::min(pairs.size(), kPoses);
  const auto chosen = [&](std::size_t i) {
    return pairs[count > 1 ? i * (pairs.size() - 1) / (count - 1) : 0];
  };
  const auto distance = [](const Trajectory& t, std::size_t a, std::size_t b) {
    return (t.poses[a].translation() - t.poses[b].translation()).norm();
  };
  std::vector<LengthPair> lengths;
  double longest = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      const PosePair a = chosen(i), b = chosen(j);
      lengths.push_back({distance(estimate, a.estimate, b.estimate),
                         distance(reference, a.reference, b.reference)});
      longest = std::max(longest, lengths.back().reference);
    }
  const auto tellsNothing = [&](const LengthPair& length) {
    return length.estimate <= 0 || length.reference <= 0 ||
           length.reference < kShort * longest;
  };
  lengths.erase(std::remove_if(lengths.begin(), lengths.end(), tellsNothing),
                lengths.end());
  return lengths;
}

} // namespace pcl6d
