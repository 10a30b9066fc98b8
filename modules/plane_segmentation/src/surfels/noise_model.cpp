// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/noise_model.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace pcl6d {

namespace {
constexpr std::size_t kMostBins = 8;
constexpr std::size_t kLeastPerBin = 32;
/** The lower quartile of standard deviations, each estimated from some 20 to 100
 * points, is 8 to 13 % too low. */
constexpr double kQuartileToSigma = 1.1;
} // namespace

NoiseModel::NoiseModel(const std::vector<double>& ranges,
                       const std::vector<double>& residuals,
                       double least)
{
  std::vector<std::size_t> order(ranges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return ranges[a] < ranges[b];
  });
  const std::size_t bins =
      std::clamp(order.size() / kLeastPerBin, std::size_t{1}, kMostBins);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::size_t begin = bin * order.size() / bins;
    const std::size_t end = (bin + 1) * order.size() / bins;
    if (begin == end)
      break;
    std::vector<double> values;
    for (std::size_t i = begin; i < end; ++i)
      values.push_back(residuals[order[i]]);
    const auto quartile =
        values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
    std::nth_element(values.begin(), quartile, values.end());
    ranges_.push_back(ranges[order[(begin + end) / 2]]);
    sigmas_.push_back(std::max(least, kQuartileToSigma * *quartile));
  }
  if (ranges_.empty()) {
    ranges_ = {0};
    sigmas_ = {least};
  }
}

double
NoiseModel::at(double range) const
{
  const auto above = std::upper_bound(ranges_.begin(), ranges_.end(), range);
  if (above == ranges_.begin())
    return sigmas_.front();
  if (above == ranges_.end())
    return sigmas_.back();
  const auto i = static_cast<std::size_t>(above - ranges_.begin());
  const double share = (range - ranges_[i - 1]) / (ranges_[i] - ranges_[i - 1]);
  return sigmas_[i - 1] + share * (sigmas_[i] - sigmas_[i - 1]);
}

} // namespace pcl6d
