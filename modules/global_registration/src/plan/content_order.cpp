// SPDX-License-Identifier: BSD-3-Clause
#include "plan/content_order.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** FNV-1a over the bits of its points. */
std::uint64_t
fingerprint(const PlaceableScan& scan)
{
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const auto& p : scan.matched().points)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t bits;
      std::memcpy(&bits, &p[k], sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3;
    }
  return hash;
}
} // namespace

std::vector<std::size_t>
contentOrder(const std::deque<PlaceableScan>& scans)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < scans.size(); ++i)
    sorted.emplace_back(fingerprint(scans[i]), i);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> order;
  for (const auto& one : sorted)
    order.push_back(one.second);
  return order;
}

} // namespace pcl6d::global_registration
