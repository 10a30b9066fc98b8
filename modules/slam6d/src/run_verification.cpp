// SPDX-License-Identifier: BSD-3-Clause
#include "registered.h"
#include "run_verification.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/slam6d/pose_bounds.h>
#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/pose_mistake.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace pcl6d::slam6d {

namespace {
/** Number of scans of each process sent at a time, a few megabytes each: the bytes sent at a time
 * must fit into memory. */
constexpr std::size_t kSharedAtATime = 8;

/** The covariances from matching treat pairs as independent, and are replaced. */
void
takeCovariances(const MapVerification& map, std::vector<ScanResult>& scans)
{
  for (std::size_t i = 0; i < map.scans.size(); ++i) {
    ScanResult& scan = scans[i];
    if (!map.scans[i].covariance || scan.state == ScanState::kPredicted)
      continue; // predicted poses have no covariance
    PoseCovariance turn = PoseCovariance::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
        scan.T_world_scan.linear();
    const PoseCovariance covariance = eulerCovariance(
        scan.T_world_scan, turn * *map.scans[i].covariance * turn.transpose());
    if (covariance.allFinite())
      scan.covariance = covariance;
  }
}

/** \return whether the pose comes from a search, which finds wrong places that look alike as well:
 * with hopeless odometry, the search around the predicted pose covers half a turn and metres */
bool
isFoundBySearch(RecoveredBy by)
{
  return by == RecoveredBy::kSearch || by == RecoveredBy::kEverywhere ||
         by == RecoveredBy::kTogether;
}

/** \return whether a scan was registered or lost since the verdict, and this changes the verdict: lost
 * scans do not count as connected */
bool
isOutdated(const MapVerification& map, const std::vector<ScanResult>& scans)
{
  for (std::size_t i = 0; i < map.scans.size(); ++i)
    if (isInMap(scans[i]) ? map.scans[i].doubt.reason == RejectReason::kScanUnregistered
                          : map.scans[i].tied)
      return true;
  return false;
}
} // namespace

void
RunVerification::prepare(const std::deque<IcpModel>& reduced,
                         const std::deque<MeasuredScan>& measured,
                         const IcpModel::Options& normals,
                         double voxel,
                         const ProgressCallback& report)
{
  surfaces_.resize(reduced.size());
  const auto surfacesOf = [&](std::size_t i) -> const IcpModel& {
    return surfaces_[i] ? *surfaces_[i] : reduced[i];
  };
  while (scans_.size() < reduced.size()) {
    const std::size_t done = scans_.size();
    const std::size_t at_a_time =
        sharing_ ? kSharedAtATime * sharing_->numRanks() : threadCount(num_threads_);
    const std::size_t count = std::min(reduced.size() - done, at_a_time);
    std::vector<VerifiedScan> ready(count);
    parallelFor(count, num_threads_, [&](std::size_t k) {
      if (reduced[done + k].normals().empty())
        surfaces_[done + k].emplace(reduced[done + k].points(), normals);
      ready[k] = VerifiedScan(surfacesOf(done + k));
    });
    const auto place = [&](std::size_t k) { return done + k; };
    sharedFor(sharing_, num_threads_, ready, place, [&](std::size_t k) {
      ready[k] = VerifiedScan(measured[done + k].points(), surfacesOf(done + k), voxel);
    });
    std::move(ready.begin(), ready.end(), std::back_inserter(scans_));
    report({"preparing", scans_.size(), reduced.size()});
  }
}

void
RunVerification::verify(const std::vector<std::string>& names, Slam6DResult& result)
{
  verify(names, {}, result);
}

void
RunVerification::verify(const std::vector<std::string>& names,
                        const MapIsKept& is_kept,
                        Slam6DResult& result)
{
  std::vector<Verified> map;
  for (const ScanResult& scan : result.scans)
    map.push_back({scan.T_world_scan,
                   isWithoutPrior(scan.start) || isFoundBySearch(scan.recovered)});
  const auto isSame = [](const Verified& a, const Verified& b) {
    return a.T_world_scan.matrix() == b.T_world_scan.matrix() &&
           a.is_unsure == b.is_unsure;
  };
  if (!result.verification || isOutdated(*result.verification, result.scans) ||
      !std::equal(map.begin(), map.end(), verified_.begin(), verified_.end(), isSame)) {
    result.verification = verdictOn(map, names, is_kept, result.scans);
    verified_ = std::move(map);
  }
  takeCovariances(*result.verification, result.scans);
}

void
RunVerification::verifyTrial(const std::vector<std::string>& names,
                             const MapIsKept& is_kept,
                             Slam6DResult& result)
{
  bool is_complete = true;
  const auto ask = [&](const std::vector<bool>& connected) {
    return is_complete = is_kept(connected);
  };
  verify(names, ask, result);
  if (!is_complete)
    verified_.clear();
}

MapVerification
RunVerification::verdictOn(const std::vector<Verified>& scans,
                           const std::vector<std::string>& names,
                           const MapIsKept& is_kept,
                           const std::vector<ScanResult>& results)
{
  std::vector<Eigen::Isometry3d> poses;
  MapVerifierOptions options;
  options.num_threads = num_threads_;
  options.sharing = sharing_;
  options.is_kept = is_kept;
  options.refined = are_refined_;
  options.memory = &links_;
  for (const Verified& scan : scans) {
    poses.push_back(scan.T_world_scan);
    options.unsure.push_back(scan.is_unsure);
  }
  for (const ScanResult& result : results)
    options.unregistered.push_back(!isInMap(result));
  std::vector<std::string> files; // file names without directories, for the text of the
                                  // verdict
  files.reserve(names.size());
  for (const std::string& name : names)
    files.push_back(std::filesystem::path(name).filename().string());
  MapVerification map = MapVerifier(scans_, files, options).verify(poses);
  factor_ = boundPoses(poses, map, num_threads_, frames_, least_factor_);
  explainDoubts(results, map);
  return map;
}

/** If many scans are disconnected or were lost, or rays cannot verify, the initial poses may be
 * systematically wrong. */
void
RunVerification::explainDoubts(const std::vector<ScanResult>& scans,
                               MapVerification& map)
{
  std::size_t loose = 0, lost = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    loose += map.scans[i].tied ? 0 : 1;
    lost += scans[i].recovered != RecoveredBy::kNone ? 1 : 0;
  }
  const bool is_loose =
      map.trust == MapTrust::kDoubtful && (lost > 0 || 3 * loose >= map.scans.size());
  if (!is_loose && map.trust != MapTrust::kUnverified)
    return;
  std::vector<Eigen::Isometry3d> initial;
  for (const ScanResult& scan : scans) {
    if (scan.start == InitialGuess::kGlobal ||
        (scan.start == InitialGuess::kFeatures && !is_loose))
      return; // started without initial poses
    initial.push_back(scan.initial_pose);
  }
  const auto isSame = [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    return a.matrix() == b.matrix();
  };
  if (!std::equal(
          initial.begin(), initial.end(), initial_.begin(), initial_.end(), isSame)) {
    mistake_ = likelyPoseMistake(scans_, initial, num_threads_);
    initial_ = std::move(initial);
  }
  if (mistake_.empty())
    return;
  map.trust = MapTrust::kDoubtful;
  Rejection& doubt = map.doubts.emplace_back(RejectReason::kPoseMistake);
  doubt.text = "initial poses: " + mistake_;
}

} // namespace pcl6d::slam6d
