// SPDX-License-Identifier: BSD-3-Clause
#include "matching/sequence_matcher.h"
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

/** \return whether a motion of the scan is that of the given poses, or of a tracked step, as surfaces
 * leave it open: no link could connect it, and another search would not either */
bool
isHeld(const ScanResult& scan)
{
  return isRegistered(scan) && scan.status == Status::kRankDeficient;
}

/** \return whether the scan is connected, or has a consistent link to a scan that is not either: a
 * right piece beside the map stays whole */
bool
isConfirmed(const MapVerification& map, std::size_t scan)
{
  return map.scans[scan].tied ||
         std::any_of(map.links.begin(), map.links.end(), [&](const LinkCheck& link) {
           return (link.from == scan || link.to == scan) &&
                  link.trust == LinkTrust::kGood;
         });
}

/** Marks a scan as lost, with the reason. */
void
lose(RejectReason reason, ScanResult& scan)
{
  scan.state = ScanState::kPredicted;
  scan.recovered = RecoveredBy::kNone;
  scan.covariance.reset();
  scan.rejections = {reason};
}

/** \return the scans to be disconnected from the map */
std::vector<std::size_t>
disconnectedScans(std::size_t keeps, const Slam6DResult& result)
{
  std::vector<std::size_t> loose;
  for (std::size_t i = std::max<std::size_t>(1, keeps); i < result.scans.size(); ++i)
    if (isInMap(result.scans[i]) && !isHeld(result.scans[i]) && !isWithFirst(result, i))
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
    if (isInMap(result.scans[i]) && !isHeld(result.scans[i]) &&
        !result.verification->scans[i].tied)
      return true;
  return false;
}

bool
isMostlyDisconnected(std::size_t keeps, const Slam6DResult& result)
{
  const auto count = std::count_if(result.scans.begin(), result.scans.end(), isInMap);
  return 2 * disconnectedScans(keeps, result).size() > static_cast<std::size_t>(count);
}

void
disconnect(std::size_t keeps, Slam6DResult& result)
{
  for (const std::size_t i : disconnectedScans(keeps, result))
    lose(RejectReason::kInconsistentPose, result.scans[i]);
}

void
disconnectPieces(Slam6DResult& result)
{
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    if (result.scans[i].recovered == RecoveredBy::kBeside) {
      lose(RejectReason::kNoConsistentLink, result.scans[i]);
      auto& floating = result.floating;
      floating.erase(std::remove(floating.begin(), floating.end(), i), floating.end());
    }
}

bool
isBetterConnected(const std::vector<bool>& connected, std::size_t before)
{
  const auto now = std::count(connected.begin(), connected.end(), true);
  return static_cast<std::size_t>(now) > before;
}

bool
isUnconfirmed(const Slam6DResult& result, std::size_t scan)
{
  const RecoveredBy by = result.scans[scan].recovered;
  return isRegistered(result.scans[scan]) &&
         (by == RecoveredBy::kSearch || by == RecoveredBy::kEverywhere) &&
         !isConfirmed(*result.verification, scan);
}

void
takeFinalPose(std::size_t scan, Slam6DResult& result)
{
  const Eigen::Isometry3d& pose = result.scans[scan].T_world_scan;
  if (scan < result.graph.poses.size())
    result.graph.poses[scan] = pose;
  for (StageResult& stage : result.stages)
    if (!stage.history.empty() && scan < stage.history.back().size())
      stage.history.back()[scan] = pose;
}

bool
returnUnconfirmed(std::size_t keeps, Slam6DResult& result)
{
  if (!result.verification || !hasGivenPoses(result.scans))
    return false;
  std::vector<bool> is_moved(result.scans.size(), false);
  for (std::size_t i = std::max<std::size_t>(1, keeps); i < is_moved.size(); ++i) {
    ScanResult& scan = result.scans[i];
    const bool is_unconfirmed = isUnconfirmed(result, i);
    is_moved[i] = is_unconfirmed || (is_moved[i - 1] && !isRegistered(scan));
    if (is_unconfirmed)
      lose(RejectReason::kNoConsistentLink, scan);
    if (!is_moved[i])
      continue;
    scan.T_world_scan = scan.matched_pose = predictedPose(result.scans, i);
    takeFinalPose(i, result);
  }
  const auto isOfMoved = [&](const auto& link) {
    return is_moved[link.from] || is_moved[link.to];
  };
  auto& links = result.graph.links;
  links.erase(std::remove_if(links.begin(), links.end(), isOfMoved), links.end());
  for (ScanLink& link : result.links)
    if (isOfMoved(link) && link.verdict == LinkVerdict::kUsed)
      link.verdict = LinkVerdict::kRefused;
  return std::find(is_moved.begin(), is_moved.end(), true) != is_moved.end();
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
