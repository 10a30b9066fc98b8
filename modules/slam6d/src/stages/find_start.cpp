// SPDX-License-Identifier: BSD-3-Clause
#include "../pipeline/pipeline.h"
#include "../registered.h"
#include "recovery/second_look.h"
#include "stages.h"

#include <algorithm>
#include <utility>

namespace pcl6d::slam6d {

namespace {
StartResult
startOf(const Slam6DResult& result, InitialGuess guess)
{
  const auto& scans = result.scans;
  StartResult start;
  start.guess = guess;
  start.registered =
      static_cast<std::size_t>(std::count_if(scans.begin(), scans.end(), isRegistered));
  start.connected = countConnected(result);
  return start;
}

/** Silences the observer while a start is tried. */
class Unobserved {
public:
  explicit Unobserved(SlamContext& context)
  : context_(context), observer_(std::exchange(context.observer, nullptr))
  {}
  ~Unobserved() { context_.observer = std::move(observer_); }
  Unobserved(const Unobserved&) = delete;
  Unobserved&
  operator=(const Unobserved&) = delete;

private:
  SlamContext& context_;
  Slam6D::Observer observer_;
};

class FindStart : public Stage {
public:
  FindStart(StageList in_order, StageList any_order)
  : in_order_(std::move(in_order)), any_order_(std::move(any_order))
  {}

  bool
  isDue(const SlamState& state) const override
  {
    return state.isWithoutSequence() && state.next < state.size();
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    const bool is_one_start = !state.options.order_first || !state.groups.empty() ||
                              state.size() < 3 || state.next > 0;
    if (is_one_start && !runStages(any_order_, state, context))
      throw Cancelled();
    if (!is_one_start)
      tryBoth(state, context);
    return StageEnd::kDone;
  }

private:
  void
  tryBoth(SlamState& state, SlamContext& context)
  {
    const Slam6DResult before = state.result;
    const std::vector<ScanPair> links = state.options.given_links;
    const bool is_whole = tryOrder(state, context);
    state.recovery.budget().begin(state.result.scans);
    auto& starts = state.result.starts;
    if (is_whole && starts[0].connected == state.size()) {
      starts[0].is_kept = true;
      return context.observe(state.result);
    }
    const Slam6DResult ordered = std::move(state.result);
    forgetRegistration(before, state);
    state.options.given_links = links;
    const bool is_continued = is_whole && isMostlyConnected(ordered);
    if (is_continued)
      keepConnected(ordered, state.result);
    else
      state.pieces.clear();
    if (!is_whole || !tryAnyOrder(state, context))
      throw Cancelled();
    StartResult any_order = startOf(state.result, InitialGuess::kGlobal);
    any_order.is_continued = is_continued;
    const bool is_ordered = ordered.starts[0].connected > any_order.connected;
    if (is_ordered) {
      state.result = ordered;
      state.options.initial_guess = InitialGuess::kOdometry;
    }
    starts = {ordered.starts[0], any_order};
    starts[0].is_kept = is_ordered || is_continued;
    starts[1].is_kept = !is_ordered;
    context.observe(state.result);
  }

  /** In the order of the scans, until too many cannot be matched. \return false if cancelled */
  bool
  tryOrder(SlamState& state, SlamContext& context)
  {
    const Unobserved unobserved(context);
    state.options.initial_guess = InitialGuess::kOdometry;
    state.is_order_tried = true;
    StartResult start{InitialGuess::kOdometry};
    start.is_complete = runStages(in_order_, state, context);
    const bool is_whole = start.is_complete || isOrderHopeless(state);
    if (start.is_complete) {
      state.result.scans.front().start = InitialGuess::kGlobal; // no measured pose
      const auto is_kept = [](const std::vector<bool>& connected) {
        return std::find(connected.begin(), connected.end(), false) == connected.end();
      };
      state.verification.verifyTrial(state.scans.names(), is_kept, state.result);
      start = startOf(state.result, InitialGuess::kOdometry);
    }
    state.result.starts = {start};
    state.is_order_tried = false;
    return is_whole;
  }

  bool
  tryAnyOrder(SlamState& state, SlamContext& context)
  {
    const Unobserved unobserved(context);
    if (!runStages(any_order_, state, context))
      return false;
    state.verification.verify(state.scans.names(), state.result);
    return true;
  }

  /** \return whether the order connects more than half of the scans: without them, no other
   * start could connect as many */
  static bool
  isMostlyConnected(const Slam6DResult& ordered)
  {
    return 2 * ordered.starts[0].connected > ordered.scans.size();
  }

  /** Keeps the scans that the order connects; the others are joined to them in any order. */
  static void
  keepConnected(const Slam6DResult& ordered, Slam6DResult& result)
  {
    bool is_first = true;
    for (std::size_t i = 0; i < result.scans.size(); ++i) {
      if (!isRegistered(ordered.scans[i]) || !ordered.verification->scans[i].tied)
        continue;
      result.scans[i] = ordered.scans[i];
      if (std::exchange(is_first, false))
        result.scans[i].state = ScanState::kFixed; // holds the world
    }
  }

  /** Restores the unregistered scans. */
  static void
  forgetRegistration(const Slam6DResult& before, SlamState& state)
  {
    state.online_loops.end();
    state.result = before;
    state.next = state.improved = 0;
    state.options.initial_guess = InitialGuess::kGlobal;
  }

  StageList in_order_, any_order_;
};
} // namespace

StagePtr
findStart(StageList in_order, StageList any_order)
{
  return std::make_unique<FindStart>(std::move(in_order), std::move(any_order));
}

} // namespace pcl6d::slam6d
