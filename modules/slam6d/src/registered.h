// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/slam6d_result.h>

#include <vector>

namespace pcl6d::slam6d {

/** \return whether a scan was matched or is fixed, which qualifies the scan for matching and
 * testing further scans */
inline bool
isRegistered(const ScanResult& scan)
{
  return scan.state == ScanState::kFixed || scan.state == ScanState::kMatched ||
         scan.state == ScanState::kUnconverged;
}

/** \return isRegistered() of each scan */
inline std::vector<bool>
areRegistered(const Slam6DResult& result)
{
  std::vector<bool> registered;
  for (const ScanResult& scan : result.scans)
    registered.push_back(isRegistered(scan));
  return registered;
}

/** \return for each scan whether its pose is one of the map: registered, and not only with the scans
 * of a piece beside the map, whose place is that of the odometry */
inline std::vector<bool>
areInMap(const Slam6DResult& result)
{
  std::vector<bool> in_map = areRegistered(result);
  for (const std::size_t i : result.floating)
    if (result.scans[i].recovered == RecoveredBy::kTogether)
      in_map[i] = false;
  return in_map;
}

} // namespace pcl6d::slam6d
