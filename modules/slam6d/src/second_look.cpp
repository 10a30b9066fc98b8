// SPDX-License-Identifier: BSD-3-Clause
#include "recovery.h"
#include "registered.h"
#include "second_look.h"

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** \return whether a scan is tied to the same part of the map as the first one */
bool
isWithFirst(const Slam6DResult& result, std::size_t scan)
{
  const auto& checks = result.verification->scans;
  return checks[scan].tied == checks[0].tied && (scan == 0 || checks[0].tied);
}

/** Lost or untied. */
std::size_t
countLoose(const Slam6DResult& result)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    count += !isRegistered(result.scans[i]) || !result.verification->scans[i].tied;
  return count;
}
} // namespace

bool
hasUntied(const Slam6DResult& result)
{
  if (!result.verification || result.verification->trust != MapTrust::kDoubtful)
    return false;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    if (isRegistered(result.scans[i]) && !result.verification->scans[i].tied)
      return true;
  return false;
}

void
loosen(std::size_t keeps, Slam6DResult& result)
{
  for (std::size_t i = std::max<std::size_t>(1, keeps); i < result.scans.size(); ++i) {
    ScanResult& scan = result.scans[i];
    if (!isRegistered(scan) || isWithFirst(result, i))
      continue;
    scan.state = ScanState::kPredicted;
    scan.recovered = RecoveredBy::kNone;
    scan.covariance.reset();
    scan.reason = "points and rays contradict where it was matched";
  }
}

bool
isBetterTied(const Slam6DResult& now, const Slam6DResult& before)
{
  return countLoose(now) < countLoose(before);
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
