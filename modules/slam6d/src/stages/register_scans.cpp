// SPDX-License-Identifier: BSD-3-Clause
#include "../registered.h"
#include "../task_names.h"
#include "recovery/piece_matcher.h"
#include "recovery/second_look.h"
#include "stages.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace pcl6d::slam6d {

namespace {
/** The order of the scans is abandoned after more breaks than one in kOneIn scans. In a random order of
 * n scans, each overlapping k scans, consecutive scans overlap with probability k / n: in large
 * folders most scans break the order. A gap in a drive is a single break, although the scans after it
 * do not match the map. */
constexpr std::size_t kOneIn = 4;

/** Each scan is registered separately: cancelling keeps the scans registered before. */
class RegisterScans : public Stage {
public:
  bool
  isDue(const SlamState& state) const override
  {
    return !state.isWithoutSequence();
  }

  bool
  isMatching() const override
  {
    return true;
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    takeInEarlier(state);
    const std::size_t total = state.size();
    if (state.next < total)
      disconnectPieces(state.result);
    PieceMatcher pieces(
        state.options, state.result.parameters, state.scans, state.recovery);
    state.breaks = 0;
    while (state.next < total && !isOrderHopeless(state) &&
           !context.cancelled.exchange(false)) {
      const std::size_t scan = state.next;
      registerScan(scan, state, context);
      if (state.is_order_tried && !pieces.take(state.result.scans[scan]) &&
          !isRegistered(state.result.scans[scan]))
        ++state.breaks;
      if (state.options.close_loops_online)
        closeLoops(scan, state);
      if (context.observer)
        context.observer(scan, state.result.scans[scan]);
      if (context.progress)
        context.progress({"matching", state.next, total});
    }
    if (state.is_order_tried)
      state.pieces = pieces.places();
    context.cancelled = false; // including a request during the last scan
    for (std::size_t i = state.next; i < total; ++i)
      state.predict(i);
    if (state.next < total)
      return StageEnd::kStopped;
    state.online_loops.end();
    return StageEnd::kDone;
  }

  void
  finish(SlamState& state, const SlamContext& context) override
  {
    for (std::size_t i = 0; i < state.next; ++i)
      if (!context.isFirst() && !state.is_order_tried)
        state.scans.dropMeasured(i);
  }

private:
  /** Adds scans registered by an earlier run. */
  static void
  takeInEarlier(SlamState& state)
  {
    for (; state.next < state.num_of_earlier_run; ++state.next) {
      state.map->takeIn(state.next, state.result.scans);
      if (state.next > 0)
        state.scans.dropMeasured(state.next - 1); // needed no more
    }
  }

  /** Advances to the next scan even if the result cannot be stored. */
  static void
  registerScan(std::size_t i, SlamState& state, SlamContext& context)
  {
    ScanResult& scan = state.result.scans[i];
    const std::uint64_t task = taskOf(state.inputs[i], state.result, state.improved);
    auto known = context.memory ? context.memory->matched(i, task) : std::nullopt;
    if (known) {
      scan = *known;
      state.map->takeIn(i, state.result.scans);
    }
    else
      state.map->match(i, state.result.scans);
    scan.matched_pose = scan.T_world_scan;
    if (i > 0 && !state.is_order_tried)
      state.scans.dropMeasured(i - 1); // needed no more
    state.next = i + 1;
    if (context.memory && !known)
      context.memory->keepMatched(i, task, scan);
  }

  /** Closes the loops of a scan before the next scan is matched. */
  static void
  closeLoops(std::size_t scan, SlamState& state)
  {
    if (!state.online_loops.isBegun())
      state.online_loops.begin(state.makeGraphStage(nullptr, state.result.parameters));
    state.online_loops.close(state.scans.reduced(), scan, state.options, state.result);
  }
};
} // namespace

bool
isOrderHopeless(const SlamState& state)
{
  return state.is_order_tried &&
         state.breaks > std::max<std::size_t>(1, state.size() / kOneIn);
}

StagePtr
registerScans()
{
  return std::make_unique<RegisterScans>();
}

} // namespace pcl6d::slam6d
