// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/map_verification.h>

#include <algorithm>
#include <cstddef>

namespace pcl6d::verification {

/** \return the consistent link of a scan with the most common surface; null if none */
inline const LinkCheck*
surestLinkOf(std::size_t scan, const MapVerification& map)
{
  const LinkCheck* most = nullptr;
  for (const LinkCheck& link : map.links)
    if ((link.from == scan || link.to == scan) && link.trust == LinkTrust::kGood &&
        (!most || link.patches > most->patches))
      most = &link;
  return most;
}

/** \return the index of the link between two scans, which exists */
inline std::size_t
linkBetween(std::size_t scan, std::size_t other, const MapVerification& map)
{
  const std::size_t from = std::min(scan, other), to = std::max(scan, other);
  const auto link =
      std::find_if(map.links.begin(), map.links.end(), [&](const auto& l) {
        return l.from == from && l.to == to;
      });
  return static_cast<std::size_t>(link - map.links.begin());
}

} // namespace pcl6d::verification
