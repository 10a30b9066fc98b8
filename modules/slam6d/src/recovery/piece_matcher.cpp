// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/piece_matcher.h"
#include "registered.h"

#include <pcl6d/common/pose.h>

namespace pcl6d::slam6d {

PieceMatcher::PieceMatcher(const Slam6DOptions& options,
                           const Slam6DParameters& parameters,
                           const KeptScans& scans,
                           Recovery& recovery)
: options_(options), parameters_(parameters), scans_(scans), recovery_(recovery)
{}

bool
PieceMatcher::take(const ScanResult& scan)
{
  const std::size_t i = own_.size();
  own_.push_back(scan);
  own_[i].state = ScanState::kPredicted; // pieces do not use the map
  if (scan.state != ScanState::kPredicted) {
    matcher_.reset();
    return false;
  }
  if (matcher_ && follow(i)) {
    piece_.push_back(i);
    return true;
  }
  for (const std::size_t earlier : piece_)
    own_[earlier].state = ScanState::kPending; // of a different piece
  own_[i].T_world_scan = scan.T_world_scan;
  matcher_.emplace(options_, parameters_);
  matcher_->fix(scans_.reduced()[i], scans_.measured()[i], own_[i]);
  piece_ = {i};
  return false;
}

/** Matches a scan with the last piece. \return whether the match is accepted */
bool
PieceMatcher::follow(std::size_t i)
{
  ScanResult& scan = own_[i];
  const ScanResult& before = own_[i - 1];
  scan.T_world_scan =
      extrapolateOdometry(before.T_world_scan, before.initial_pose, scan.initial_pose);
  scan.rejections.clear();
  matcher_->match(scans_.reduced()[i],
                  scans_.measured()[i],
                  before.initial_pose.inverse() * scan.initial_pose,
                  scan,
                  [&](const ScanResult& found) {
                    return recovery_.rejectionOf(i, found.T_world_scan, own_);
                  });
  if (isRegistered(scan))
    return true;
  const auto found =
      isBounded(options_) ? recovery_.findByMotion(i, own_) : recovery_.find(i, own_);
  if (!found)
    return false;
  scan.T_world_scan = found->T_world_scan;
  matcher_->matchFound(scans_.reduced()[i], scans_.measured()[i], scan);
  return isRegistered(scan);
}

} // namespace pcl6d::slam6d
