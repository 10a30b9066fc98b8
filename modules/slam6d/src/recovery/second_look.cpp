// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/recovery.h"
#include "recovery/second_look.h"
#include "registered.h"

#include <algorithm>
#include <vector>

namespace pcl6d::slam6d {

namespace {
/** \return whether a scan is connected to the component of the first scan */
bool
isWithFirst(const Slam6DResult& result, std::size_t scan)
{
  const auto& checks = result.verification->scans;
  return checks[scan].tied == checks[0].tied && (scan == 0 || checks[0].tied);
}

/** \return the scans to be disconnected from the map */
std::vector<std::size_t>
disconnectedScans(std::size_t keeps, const Slam6DResult& result)
{
  std::vector<std::size_t> loose;
  for (std::size_t i = std::max<std::size_t>(1, keeps); i < result.scans.size(); ++i)
    if (isRegistered(result.scans[i]) && !isWithFirst(result, i))
      loose.push_back(i);
  return loose;
}
} // namespace

std::size_t
countConnected(const Slam6DResult& result)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    count += isRegistered(result.scans[i]) && result.verification->scans[i].tied;
  return count;
}

bool
hasDisconnected(const Slam6DResult& result)
{
  if (!result.verification || result.verification->trust != MapTrust::kDoubtful)
    return false;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    if (isRegistered(result.scans[i]) && !result.verification->scans[i].tied)
      return true;
  return false;
}

bool
isMostlyDisconnected(std::size_t keeps, const Slam6DResult& result)
{
  const std::vector<bool> registered = areRegistered(result);
  const auto count = std::count(registered.begin(), registered.end(), true);
  return 2 * disconnectedScans(keeps, result).size() > static_cast<std::size_t>(count);
}

void
disconnect(std::size_t keeps, Slam6DResult& result)
{
  for (const std::size_t i : disconnectedScans(keeps, result)) {
    ScanResult& scan = result.scans[i];
    scan.state = ScanState::kPredicted;
    scan.recovered = RecoveredBy::kNone;
    scan.covariance.reset();
    scan.rejections = {RejectReason::kInconsistentPose};
  }
}

bool
isBetterConnected(const Slam6DResult& now, const Slam6DResult& before)
{
  return countConnected(now) > countConnected(before);
}

void
keepMatchedPoses(const Slam6DResult& before, Slam6DResult& now)
{
  for (std::size_t i = 0; i < now.scans.size(); ++i)
    if (now.scans[i].recovered == before.scans[i].recovered &&
        isRegistered(now.scans[i]))
      now.scans[i].matched_pose = before.scans[i].matched_pose;
}

} // namespace pcl6d::slam6d
