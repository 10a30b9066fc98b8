// SPDX-License-Identifier: BSD-3-Clause
#include "matching/sequence_matcher.h"
#include "recovery/piece_matcher.h"
#include "registered.h"

#include <pcl6d/common/pose.h>

#include <algorithm>

namespace pcl6d::slam6d {

std::vector<std::size_t>
comparedOfPiece(const std::vector<std::size_t>& piece)
{
  constexpr std::size_t kCompared = 4;
  const std::size_t count = std::min(kCompared, piece.size());
  std::vector<std::size_t> some;
  for (std::size_t k = 0; k < count; ++k)
    some.push_back(piece[count == 1 ? 0 : k * (piece.size() - 1) / (count - 1)]);
  return some;
}

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
    pieces_.back().push_back(i);
    return true;
  }
  if (!pieces_.empty())
    for (const std::size_t earlier : pieces_.back())
      own_[earlier].state = ScanState::kPending; // of a different piece
  own_[i].T_world_scan = scan.T_world_scan;
  matcher_.emplace(options_, parameters_);
  matcher_->fix(scans_.reduced()[i], scans_.measured()[i], own_[i]);
  pieces_.push_back({i});
  return false;
}

std::vector<std::optional<KnownPlace>>
PieceMatcher::places() const
{
  std::vector<std::optional<KnownPlace>> places(own_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    if (pieces_[p].size() > 1)
      for (const std::size_t i : pieces_[p])
        places[i] = KnownPlace{p + 1, own_[i].T_world_scan};
  return places;
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
  matcher_->setHoldsOpenDirections(hasGivenPoses(own_));
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
