// SPDX-License-Identifier: BSD-3-Clause
#include "../registered.h"
#include "map.h"

#include <algorithm>

namespace pcl6d::slam6d {

Map::Map(const Slam6DOptions& options,
         const Slam6DParameters& parameters,
         const KeptScans& scans,
         Recovery& recovery)
: options_(options), parameters_(parameters), scans_(scans), recovery_(recovery)
{
  matcher_.emplace(options, parameters, scans, recovery);
}

void
Map::match(std::size_t scan, std::vector<ScanResult>& scans)
{
  update(scan, scans);
  matcher_->match(scan, scans);
  note(scan + 1, scans);
}

void
Map::takeIn(std::size_t scan, const std::vector<ScanResult>& scans)
{
  update(scan, scans);
  matcher_->takeIn(scan, scans);
  note(scan + 1, scans);
}

KnownPlaces
Map::recover(const ProgressCallback& report, Slam6DResult& result)
{
  update(result.scans.size(), result.scans);
  taken_.clear(); // after an interruption the map may contain recovered scans
  KnownPlaces beside = matcher_->recover(report, result);
  note(result.scans.size(), result.scans);
  return beside;
}

/** Rebuilds the map of the first scans, unless it contains exactly these scans. */
void
Map::update(std::size_t count, const std::vector<ScanResult>& scans)
{
  // A lost scan is not in the map; its pose matters only to the scan after it.
  const auto isSame = [&](const Taken& taken, const ScanResult& scan) {
    return taken.is_registered == isRegistered(scan) &&
           ((!taken.is_registered && &taken != &taken_.back()) ||
            taken.T_world_scan.matrix() == scan.T_world_scan.matrix());
  };
  if (revision_ == scans_.revision() && taken_.size() == count &&
      std::equal(taken_.begin(), taken_.end(), scans.begin(), isSame))
    return;
  revision_ = scans_.revision();
  taken_.clear();
  matcher_.emplace(options_, parameters_, scans_, recovery_);
  for (std::size_t i = 0; i < count; ++i)
    matcher_->takeIn(i, scans);
  note(count, scans);
}

/** Records the newly added scans. */
void
Map::note(std::size_t count, const std::vector<ScanResult>& scans)
{
  taken_.resize(std::min(taken_.size(), count));
  for (std::size_t i = taken_.size(); i < count; ++i)
    taken_.push_back({isRegistered(scans[i]), scans[i].T_world_scan});
}

} // namespace pcl6d::slam6d
