// SPDX-License-Identifier: BSD-3-Clause
#include "../registered.h"
#include "graph/graph_stage.h"
#include "matching/sequence_matcher.h"
#include "recovery/second_look.h"
#include "stages.h"

#include <pcl6d/common/components.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl6d::slam6d {

namespace {
/** Pieces: the scans of each, in order. */
using Pieces = std::vector<std::vector<std::size_t>>;

/** \return the pieces whose scans are all lost */
Pieces
lostPieces(const SlamState& state)
{
  Pieces pieces;
  for (std::size_t i = 0; i < state.beside.size(); ++i) {
    if (!state.beside[i])
      continue;
    const std::size_t group = state.beside[i]->group;
    if (group >= pieces.size())
      pieces.resize(group + 1);
    pieces[group].push_back(i);
  }
  const auto isFound = [&](const std::vector<std::size_t>& piece) {
    return piece.size() < 2 ||
           std::any_of(piece.begin(), piece.end(), [&](std::size_t i) {
             return state.result.scans[i].state != ScanState::kPredicted;
           });
  };
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(), isFound), pieces.end());
  return pieces;
}

/** For each scan of a piece the first scan of the part that it is matched with. */
using Firsts = std::vector<std::size_t>;

void
setFloating(std::size_t scan, bool is_floating, Slam6DResult& result)
{
  auto& floating = result.floating;
  floating.erase(std::remove(floating.begin(), floating.end(), scan), floating.end());
  if (is_floating)
    floating.insert(std::upper_bound(floating.begin(), floating.end(), scan), scan);
}

/** Registers a scan at the pose that it has relative to the first scan of its part. */
void
placeWith(std::size_t first, std::size_t scan, SlamState& state)
{
  ScanResult& placed = state.result.scans[scan];
  placed.T_world_scan = state.result.scans[first].T_world_scan *
                        state.beside[first]->T_group_scan.inverse() *
                        state.beside[scan]->T_group_scan;
  placed.state =
      placed.status == Status::kOk ? ScanState::kMatched : ScanState::kUnconverged;
  placed.recovered = RecoveredBy::kBeside;
  placed.rejections.clear();
}

/** The first scan of each part follows the odometry from the scan before, and stays lost, like single
 * lost scans behind a piece.
 * \param[in] lost the scans before any piece was registered */
void
placePieces(const Firsts& firsts,
            const Pieces& pieces,
            const std::vector<ScanResult>& lost,
            SlamState& state)
{
  Slam6DResult& result = state.result;
  std::vector<bool> is_of_piece(state.size(), false), is_moved(state.size(), false);
  for (const auto& piece : pieces)
    for (const std::size_t i : piece)
      is_of_piece[i] = true;
  for (std::size_t i = 1; i < state.size(); ++i) {
    is_moved[i] = is_of_piece[i] || (is_moved[i - 1] && !isRegistered(lost[i]));
    if (!is_moved[i])
      continue;
    ScanResult& scan = result.scans[i];
    scan = lost[i];
    const bool is_with_first = is_of_piece[i] && firsts[i] != i;
    setFloating(i, is_with_first, result);
    if (is_with_first)
      placeWith(firsts[i], i, state);
    else
      state.predict(i);
    scan.matched_pose = scan.T_world_scan;
    takeFinalPose(i, result);
  }
}

class RegisterPieces : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    return state.options.verify && state.result.verification &&
           state.beside.size() == state.size() && !state.isWithoutSequence() &&
           hasGivenPoses(state.result.scans) && !lostPieces(state).empty();
  }

  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    const Pieces pieces = lostPieces(state);
    const std::vector<ScanResult> lost = state.result.scans;
    Components parts(state.size()); // first by matches, then by consistent links
    for (const auto& piece : pieces)
      for (const std::size_t i : piece)
        parts.join(piece.front(), i);
    placePieces(parts.firsts(), pieces, lost, state);
    state.verification.verify(state.scans.names(), state.result);
    placePieces(confirmedParts(state), pieces, lost, state);
    state.verification.verify(state.scans.names(), state.result);
    return countRegistered(pieces, state.result) > 0 ? StageEnd::kDone
                                                     : StageEnd::kReverted;
  }

  static Firsts
  confirmedParts(const SlamState& state)
  {
    Components parts(state.size());
    for (const LinkCheck& link : state.result.verification->links)
      if (link.trust == LinkTrust::kGood && state.beside[link.from] &&
          state.beside[link.to] &&
          state.beside[link.from]->group == state.beside[link.to]->group)
        parts.join(link.from, link.to);
    return parts.firsts();
  }

  static std::size_t
  countRegistered(const Pieces& pieces, const Slam6DResult& result)
  {
    std::size_t count = 0;
    for (const auto& piece : pieces)
      for (const std::size_t i : piece)
        count += isRegistered(result.scans[i]) ? 1 : 0;
    return count;
  }
};
} // namespace

StagePtr
registerPieces()
{
  return std::make_unique<RegisterPieces>();
}

} // namespace pcl6d::slam6d
