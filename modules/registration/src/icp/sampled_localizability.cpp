// SPDX-License-Identifier: BSD-3-Clause
#include "icp/sampled_localizability.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kSample = 400; ///< pairs: a few per cent of error, under 1 ms
constexpr std::size_t kNeighbours = 10;

/** \return the k-th of count places in [0, size): multiples of the golden section, which
 * keep no step with scan lines or faces that take turns; all places if count is size */
std::size_t
spread(std::size_t k, std::size_t count, std::size_t size)
{
  if (count == size)
    return k;
  constexpr double kGolden = 0.6180339887498949;
  const double share = kGolden * static_cast<double>(k);
  return static_cast<std::size_t>((share - std::floor(share)) *
                                  static_cast<double>(size));
}

/** \return the normal at a partner, in the target's frame */
Eigen::Vector3d
normalOf(const IcpTargetPart& part, const Partner& partner)
{
  const Eigen::Vector3f& point = (*part.points)[partner.index];
  const Eigen::Vector3f normal =
      part.normals ? (*part.normals)[partner.index]
                   : normalAt(point, *part.tree, *part.points, kNeighbours);
  return part.T_target_part.linear() * normal.cast<double>();
}
} // namespace

std::optional<Localizability>
sampledLocalizability(const IcpTarget& target,
                      const Points& source,
                      const Placement& at,
                      const std::vector<Partner>& partners)
{
  std::vector<std::size_t> paired;
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i].weight > 0)
      paired.push_back(i);
  const std::size_t count = std::min(kSample, paired.size());
  PlaneAccumulator sums;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = paired[spread(k, count, paired.size())];
    const Partner& partner = partners[i];
    const IcpTargetPart& part = target[partner.part];
    if (!part.normals && !part.tree)
      return std::nullopt;
    sums.add(at(source[i]), partner.point.cast<double>(), normalOf(part, partner));
  }
  if (sums.sums().count == 0)
    return std::nullopt;
  return localizabilityOf(sums.sums());
}

} // namespace pcl6d::registration
