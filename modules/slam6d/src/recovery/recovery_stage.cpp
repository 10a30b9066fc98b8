// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/piece_matcher.h"
#include "recovery/recovery_stage.h"
#include "registered.h"

#include <pcl6d/common/pose.h>

#include <algorithm>
#include <deque>
#include <set>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Up to kAllCompared scans, all pairs with lost scans are compared, at 10 ms each. With more
 * scans, a lost scan is compared with kCompared scans before and after, and with the kCompared
 * scans nearest to its predicted position. */
constexpr std::size_t kAllCompared = 150, kCompared = 50;

/** In a bounded search, a scan is compared with its neighbours in time, up to kNeighbours away, and
 * with the kNeighbours nearest scans. */
constexpr std::size_t kNeighbours = 12;

/** Takes over the figures of a match within a piece. */
void
takeFigures(const ScanResult& match, ScanResult& scan)
{
  scan.status = match.status;
  scan.pairs = match.pairs;
  scan.rms = match.rms;
  scan.overlap = match.overlap;
  scan.iterations = match.iterations;
  scan.correction = match.correction;
}

/** \return the result of a search that found no scan a place in the map, which is group 0 */
JoinedScans
nothingJoined(const Slam6DResult& result)
{
  JoinedScans joined;
  joined.groups.resize(1);
  joined.scans.resize(result.scans.size());
  for (JoinedScan& scan : joined.scans)
    scan.group = 1;
  return joined;
}
} // namespace

RecoveryStage::RecoveryStage(const Slam6DOptions& options,
                             const KeptScans& scans,
                             Recovery& recovery,
                             ScanMatcher& matcher)
: options_(options), scans_(scans), recovery_(recovery), matcher_(matcher)
{}

KnownPlaces
RecoveryStage::run(const ProgressCallback& report, Slam6DResult& result)
{
  if (countScans(result.scans, ScanState::kPredicted) == 0)
    return {};
  std::vector<Piece> pieces = piecesOf(report, result);
  placeBackwards(pieces, result);
  if (pieces.empty())
    return {};
  const bool is_any_searched =
      std::any_of(pieces.begin(), pieces.end(), [this](const Piece& piece) {
        return !whyInVain(piece);
      });
  JoinedScans joined = nothingJoined(result);
  if (is_any_searched && isBounded(options_) && recovery_.budget().pairsLeft() == 0)
    recovery_.budget().leaveOut(askedOf(pieces).size());
  else if (is_any_searched)
    joined = join(pieces, report, result);
  return take(joined, pieces, result);
}

/** \return why a search for a piece finds nothing: a single scan that no link can confirm; empty:
 * the piece is searched for */
Rejection
RecoveryStage::whyInVain(const Piece& piece) const
{
  return piece.size() > 1 ? Rejection() : recovery_.whyUnconfirmable(piece.front());
}

std::vector<RecoveryStage::Piece>
RecoveryStage::piecesOf(const ProgressCallback& report, const Slam6DResult& result)
{
  PieceMatcher matcher(options_, result.parameters, scans_, recovery_);
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    if (report)
      report({"matching what is lost", i, result.scans.size()});
    matcher.take(result.scans[i]);
  }
  own_ = matcher.own();
  return matcher.pieces();
}

/** Registers pieces by the odometry of the scans after them, and removes these pieces from the
 * list. The last piece comes first, because it may help to register earlier pieces. */
void
RecoveryStage::placeBackwards(std::vector<Piece>& pieces, Slam6DResult& result)
{
  for (std::size_t p = pieces.size(); p-- > 0;) {
    const Piece piece = pieces[p];
    const auto T_world_piece = recovery_.findBefore(piece, own_, result.scans);
    if (!T_world_piece)
      continue;
    for (std::size_t k = piece.size(); k-- > 0;)
      takePlace(piece[k],
                *T_world_piece * own_[piece[k]].T_world_scan,
                piece.size() > 1 ? RecoveredBy::kTogether : RecoveredBy::kSearch,
                result);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(p));
  }
}

/** \return the scans of each piece to search for */
std::vector<std::size_t>
RecoveryStage::askedOf(const std::vector<Piece>& pieces) const
{
  std::vector<std::size_t> asked;
  for (const Piece& piece : pieces) {
    if (whyInVain(piece))
      continue;
    const Piece some = isBounded(options_) ? comparedOfPiece(piece) : piece;
    asked.insert(asked.end(), some.begin(), some.end());
  }
  return asked;
}

/** \return pairs of a scan to search for and a scan near in time or in space */
std::vector<std::pair<std::size_t, std::size_t>>
RecoveryStage::likelyPairs(const std::vector<std::size_t>& asked,
                           const Slam6DResult& result) const
{
  const std::size_t count = result.scans.size();
  if (count <= kAllCompared && !isBounded(options_))
    return {};
  const std::size_t near = isBounded(options_) ? kNeighbours : kCompared;
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const std::size_t i : asked) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < count; ++k) {
      if (k == i)
        continue;
      if (std::max(i, k) - std::min(i, k) <= near)
        pairs.insert(std::minmax(i, k));
      others.emplace_back((result.scans[k].T_world_scan.translation() -
                           result.scans[i].T_world_scan.translation())
                              .squaredNorm(),
                          k);
    }
    std::sort(others.begin(), others.end());
    for (std::size_t k = 0; k < std::min(near, others.size()); ++k)
      pairs.insert(std::minmax(i, others[k].second));
  }
  return {pairs.begin(), pairs.end()};
}

/** The map is the first known group; each piece of several scans is a further group. */
JoinedScans
RecoveryStage::join(const std::vector<Piece>& pieces,
                    const ProgressCallback& report,
                    const Slam6DResult& result)
{
  std::deque<PlaceableScan> list;
  JoinOptions join;
  join.memory = &recovery_.pairs();
  join.num_threads = options_.num_threads;
  join.progress = report;
  join.pairs = likelyPairs(askedOf(pieces), result);
  if (isBounded(options_)) {
    join.free_pairs = &recovery_.budget().paidPairs();
    join.max_pairs = recovery_.budget().pairsLeft();
  }
  join.known.resize(result.scans.size());
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    list.push_back(recovery_.placeable(i));
    if (isRegistered(result.scans[i]))
      join.known[i] = {0, result.scans[i].T_world_scan};
  }
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (pieces[p].size() > 1)
      for (const std::size_t i : pieces[p])
        join.known[i] = {p + 1, own_[i].T_world_scan};
  JoinedScans joined = joinScans(list, join);
  recovery_.budget().spendPairs(joined.pairs_paid, joined.pairs_left_out);
  return joined;
}

KnownPlaces
RecoveryStage::take(const JoinedScans& joined,
                    const std::vector<Piece>& pieces,
                    Slam6DResult& result)
{
  std::vector<bool> is_in_piece(result.scans.size(), false);
  for (const Piece& piece : pieces)
    for (const std::size_t i : piece)
      is_in_piece[i] = piece.size() > 1;
  for (const std::size_t i : joined.groups.front()) // in the order of joining
    if (!isRegistered(result.scans[i]))
      takePlace(i,
                joined.scans[i].T_group_scan,
                is_in_piece[i] ? RecoveredBy::kTogether : RecoveredBy::kEverywhere,
                result);
  KnownPlaces beside(result.scans.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Piece& piece = pieces[p];
    const JoinedScan& first = joined.scans[piece.front()];
    const Rejection in_vain = whyInVain(piece);
    if (first.group == 0)
      continue;
    layBeside(piece, in_vain ? in_vain : first.rejection, result);
    if (piece.size() > 1)
      for (const std::size_t i : piece)
        beside[i] = KnownPlace{p, own_[i].T_world_scan};
  }
  return beside;
}

/** Matches a scan from its recovered pose in the map. */
void
RecoveryStage::takePlace(std::size_t i,
                         const Eigen::Isometry3d& T_world_scan,
                         RecoveredBy by,
                         Slam6DResult& result)
{
  ScanResult& scan = result.scans[i];
  const Eigen::Isometry3d predicted = scan.T_world_scan;
  std::vector<Rejection> rejections = scan.rejections;
  scan.T_world_scan = T_world_scan;
  if (i > 0)
    matcher_.passOver(scans_.measured()[i - 1], result.scans[i - 1].T_world_scan);
  matcher_.matchFound(scans_.reduced()[i], scans_.measured()[i], scan);
  if (!isRegistered(scan)) {
    scan.T_world_scan = predicted;
    rejections.emplace_back(RejectReason::kNotMatchedWhereFound,
                            scan.rejections.front());
    scan.rejections = std::move(rejections);
    return;
  }
  scan.matched_pose = scan.T_world_scan;
  scan.correction = (scan.T_world_scan.translation() - predicted.translation()).norm();
  scan.recovered = by;
}

/** A piece without an accepted pose in the map follows the odometry, scan by scan: a single wrong
 * match within the piece would shift all later scans, and the verdict on the links of the piece comes
 * later (registerPieces()). Without odometry, the matches are the only information. */
void
RecoveryStage::layBeside(const Piece& piece,
                         const Rejection& why,
                         Slam6DResult& result) const
{
  const std::size_t first = piece.front();
  const auto follow = [&](std::size_t i) {
    const ScanResult& before = result.scans[i - 1];
    result.scans[i].T_world_scan = extrapolateOdometry(
        before.T_world_scan, before.initial_pose, result.scans[i].initial_pose);
  };
  if (first > 0)
    follow(first);
  const bool has_odometry = std::any_of(piece.begin(), piece.end(), [&](std::size_t i) {
    return !result.scans[i].initial_pose.isApprox(result.scans[first].initial_pose);
  });
  const Eigen::Isometry3d T_world_piece =
      result.scans[first].T_world_scan * own_[first].T_world_scan.inverse();
  for (const std::size_t i : piece) {
    ScanResult& one = result.scans[i];
    if (i > first && has_odometry)
      follow(i);
    else
      one.T_world_scan = T_world_piece * own_[i].T_world_scan;
    one.matched_pose = one.T_world_scan;
    one.state = ScanState::kPredicted;
    if (i > first)
      takeFigures(own_[i], one);
    if (piece.size() > 1)
      one.rejections.emplace_back(RejectReason::kLostTogether,
                                  static_cast<double>(piece.size() - 1));
    if (why)
      one.rejections.emplace_back(RejectReason::kNoPoseInMap, why);
  }
}

} // namespace pcl6d::slam6d
