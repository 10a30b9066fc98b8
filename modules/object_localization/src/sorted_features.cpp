// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/boosting.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace pcl6d {
namespace {
constexpr std::uint16_t kNextIsEqual = 0x8000;
constexpr std::uint16_t kWindow = 0x7fff;
constexpr std::size_t kBlock = 64; // features per piece of work

/** \return a number whose order is that of the float */
std::uint32_t
orderedBits(float value)
{
  value += 0.0f; // -0 becomes 0
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

constexpr int kIndexBits = 16;

/** \brief Sorts by the upper bits; what is equal keeps its order. */
void
sortByValue(std::vector<std::uint64_t>& keys, std::vector<std::uint64_t>& spare)
{
  constexpr int kDigitBits = 11, kPasses = 3; // 32 bits
  constexpr std::uint64_t kDigit = (1u << kDigitBits) - 1;
  spare.resize(keys.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    const int shift = kIndexBits + pass * kDigitBits;
    std::array<std::uint32_t, kDigit + 2> first{};
    for (const auto key : keys)
      ++first[(key >> shift & kDigit) + 1];
    for (std::size_t digit = 0; digit < kDigit; ++digit)
      first[digit + 1] += first[digit];
    for (const auto key : keys)
      spare[first[key >> shift & kDigit]++] = key;
    keys.swap(spare);
  }
}
} // namespace

SortedFeatures::SortedFeatures(const WindowBatch& windows,
                               const std::vector<HaarFeature>& features,
                               unsigned int num_threads)
: windows_(windows), features_(features), num_threads_(num_threads)
{
  require(windows.size() <= kMostWindows,
          "number of windows",
          windows.size(),
          "<= " + std::to_string(kMostWindows));
  require(!features.empty(), "number of features", features.size(), "> 0");
  order_.resize(features.size() * windows.size());
  parallelBlocks(features.size(), kBlock, num_threads, [&](const Block& block) {
    std::vector<float> values(windows_.size());
    std::vector<std::uint64_t> keys(windows_.size()), spare;
    for (std::size_t f = block.begin; f < block.end; ++f)
      sortFeature(f, values, keys, spare);
  });
}

void
SortedFeatures::sortFeature(std::size_t feature,
                            std::vector<float>& values,
                            std::vector<std::uint64_t>& keys,
                            std::vector<std::uint64_t>& spare)
{
  windows_.valuesOf(features_[feature], values.data());
  for (std::size_t i = 0; i < keys.size(); ++i)
    keys[i] = std::uint64_t{orderedBits(values[i])} << kIndexBits | i;
  sortByValue(keys, spare);
  std::uint16_t* const order = &order_[feature * keys.size()];
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool equal =
        i + 1 < keys.size() && keys[i] >> kIndexBits == keys[i + 1] >> kIndexBits;
    order[i] =
        static_cast<std::uint16_t>((keys[i] & kWindow) | (equal ? kNextIsEqual : 0));
  }
}

// With sums u, v of the weights and a, b of the responses on both sides, the error is
// least where a^2 / u + b^2 / v is largest. Fractions are compared without division.
SortedFeatures::Cut
SortedFeatures::bestCut(std::size_t feature,
                        const std::vector<Weighted>& samples,
                        const double total_weight,
                        const double total_response) const
{
  const std::uint16_t* const order = &order_[feature * windows_.size()];
  const double least = 1e-9 * total_weight; // on a side: below, rounding decides
  double u = 0, a = 0, best_numerator = 0, best_denominator = 1;
  Cut cut;
  for (std::size_t i = 0; i + 1 < windows_.size(); ++i) {
    const Weighted& sample = samples[order[i] & kWindow];
    u += sample.weight;
    a += sample.response;
    const double v = total_weight - u, b = total_response - a;
    const double numerator = a * a * v + b * b * u, denominator = u * v;
    if (numerator * best_denominator > best_numerator * denominator && u > least &&
        v > least && (order[i] & kNextIsEqual) == 0) {
      best_numerator = numerator;
      best_denominator = denominator;
      cut.place = i;
    }
  }
  cut.gain = best_numerator / best_denominator -
             total_response * total_response / total_weight;
  return cut;
}

float
SortedFeatures::thresholdBehind(std::size_t feature, std::size_t place) const
{
  std::vector<float> values(windows_.size());
  windows_.valuesOf(features_[feature], values.data());
  const std::uint16_t* const order = &order_[feature * windows_.size()];
  const float low = values[order[place] & kWindow];
  const float high = values[order[place + 1] & kWindow];
  const float middle = low + 0.5f * (high - low);
  return middle > low ? middle : high;
}

SortedFeatures::Split
SortedFeatures::bestSplit(const std::vector<Weighted>& samples,
                          const std::vector<std::size_t>& among) const
{
  require(samples.size() == windows_.size(),
          "number of samples",
          samples.size(),
          "that of the windows");
  double weight = 0, response = 0;
  for (const auto& sample : samples) {
    weight += sample.weight;
    response += sample.response;
  }
  if (!(weight > 0))
    return {};
  const auto featureAt = [&](std::size_t i) { return among.empty() ? i : among[i]; };
  std::vector<Cut> cuts(among.empty() ? features_.size() : among.size());
  parallelBlocks(cuts.size(), kBlock, num_threads_, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i)
      cuts[i] = bestCut(featureAt(i), samples, weight, response);
  });
  const auto best =
      std::max_element(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return a.gain < b.gain;
      });
  if (!(best->gain > 1e-12 * weight))
    return {};
  const std::size_t feature = featureAt(static_cast<std::size_t>(best - cuts.begin()));
  return {true, feature, thresholdBehind(feature, best->place), best->gain};
}

} // namespace pcl6d
