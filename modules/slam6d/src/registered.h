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

/** \return whether a scan was registered with the scans of the map, not only with those of a piece
 * beside the map */
inline bool
isInMap(const ScanResult& scan)
{
  return isRegistered(scan) && scan.recovered != RecoveredBy::kBeside;
}

} // namespace pcl6d::slam6d
