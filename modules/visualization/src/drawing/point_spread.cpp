// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/point_spread.h"

#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::visualization {

std::vector<std::size_t>
thinned(const std::vector<std::size_t>& indices, std::size_t budget)
{
  if (indices.size() <= budget)
    return indices;
  const double share =
      static_cast<double>(budget) / static_cast<double>(indices.size());
  const auto limit = static_cast<std::uint64_t>(std::ldexp(share, 64));
  std::vector<std::size_t> kept;
  kept.reserve(budget + budget / 100);
  for (const auto i : indices)
    if (mixBits(i) < limit && kept.size() < budget)
      kept.push_back(i);
  return kept;
}

float
quantile(std::vector<float> values, double share)
{
  const auto rank = static_cast<std::ptrdiff_t>(
      std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double
pixelSpacing(const std::vector<Eigen::Vector3f>& pixels, int width, int height)
{
  constexpr float kCell = 8; // [px]
  const auto columns = static_cast<std::size_t>(static_cast<float>(width) / kCell) + 1;
  const auto rows = static_cast<std::size_t>(static_cast<float>(height) / kCell) + 1;
  std::vector<bool> occupied(columns * rows, false);
  for (const auto& p : pixels)
    occupied[static_cast<std::size_t>(p.y() / kCell) * columns +
             static_cast<std::size_t>(p.x() / kCell)] = true;
  const auto cells = std::count(occupied.begin(), occupied.end(), true);
  return kCell *
         std::sqrt(static_cast<double>(cells) /
                   static_cast<double>(std::max<std::size_t>(pixels.size(), 1)));
}

} // namespace pcl6d::visualization
