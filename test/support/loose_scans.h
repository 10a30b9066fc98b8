// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/verification/map_verifier.h>

#include <cstddef>
#include <set>

namespace pcl6d::test {

/** \return the indices of the scans that nothing ties to the rest */
inline std::set<std::size_t>
looseOf(const MapVerification& map)
{
  std::set<std::size_t> loose;
  for (std::size_t i = 0; i < map.scans.size(); ++i)
    if (!map.scans[i].tied)
      loose.insert(i);
  return loose;
}

} // namespace pcl6d::test
