// SPDX-License-Identifier: BSD-3-Clause
#include "icp/pair_weights.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::registration {

namespace {
/** The square of the distance within which a share of the pairs lies. */
float
trimAt(double share, const std::vector<Partner>& partners)
{
  std::vector<float> distances;
  for (const Partner& partner : partners)
    if (partner.weight > 0)
      distances.push_back(partner.distance_sq);
  if (distances.empty())
    return 0;
  const auto kept = static_cast<std::size_t>(std::ceil(share * distances.size()));
  const auto last = distances.begin() + (std::max<std::size_t>(kept, 1) - 1);
  std::nth_element(distances.begin(), last, distances.end());
  return *last;
}

/** 1.4826 times the median of the residuals: the standard deviation if they are normal,
 * whatever a minority of outliers does (MAD about zero). */
double
scaleOf(const std::vector<float>& residuals, const std::vector<Partner>& partners)
{
  std::vector<float> of_pairs;
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i].weight > 0)
      of_pairs.push_back(residuals[i]);
  if (of_pairs.empty())
    return 0;
  const auto middle = of_pairs.begin() + of_pairs.size() / 2;
  std::nth_element(of_pairs.begin(), middle, of_pairs.end());
  return 1.4826 * *middle;
}
} // namespace

void
weightPairs(const IcpOptions& options,
            const std::vector<float>& residuals,
            std::vector<Partner>& partners)
{
  if (options.kept_share < 1) {
    const float limit_sq = trimAt(options.kept_share, partners);
    for (Partner& partner : partners)
      if (partner.distance_sq > limit_sq)
        partner.weight = 0;
  }
  if (options.robust == RobustKernel::kNone)
    return;
  constexpr double kLeastScale = 1e-6; // [m] finer than any scanner: exact copies
  const double scale = std::max(scaleOf(residuals, partners), kLeastScale);
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i].weight > 0)
      partners[i].weight =
          static_cast<float>(robustWeight(options.robust, residuals[i] / scale));
}

} // namespace pcl6d::registration
