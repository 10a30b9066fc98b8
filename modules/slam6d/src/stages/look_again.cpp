// SPDX-License-Identifier: BSD-3-Clause
#include "../pipeline/pipeline.h"
#include "../registered.h"
#include "recovery/second_look.h"
#include "stages.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

namespace {
class LookAgain : public Stage {
public:
  LookAgain(StageList recovering, StageList relaxing)
  : recovering_(std::move(recovering)), relaxing_(std::move(relaxing))
  {}

  bool
  isDue(const SlamState& state) const override
  {
    return state.options.verify && isRecovering(state.options) &&
           hasDisconnected(state.result) &&
           (!isBounded(state.options) ||
            !isMostlyDisconnected(state.num_of_earlier_run, state.result));
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    const RecoveryBudget before = state.recovery.budget();
    const KnownPlaces beside = state.beside;
    try {
      const StageEnd end = look(state, context);
      if (end == StageEnd::kReverted)
        state.beside = beside;
      return end;
    } catch (...) { // cancelled: the next call looks with as much
      state.recovery.budget() = before;
      state.beside = beside;
      throw;
    }
  }

private:
  StageEnd
  look(SlamState& state, SlamContext& context)
  {
    if (isBounded(state.options) &&
        !state.recovery.budget().spendSecondLook(countRegistered(state.result)))
      return StageEnd::kReverted;
    const Slam6DResult before = state.result;
    const std::size_t num_connected = countConnected(before);
    disconnect(state.num_of_earlier_run, state.result);
    runAgain(recovering_, state, context);
    if (!isBetterConnected(areRegistered(state.result), num_connected))
      return StageEnd::kReverted; // whatever the verification connects
    runAgain(relaxing_, state, context);
    bool is_better = false;
    const auto is_kept = [&](const std::vector<bool>& connected) {
      std::vector<bool> counted = areRegistered(state.result);
      for (std::size_t i = 0; i < counted.size(); ++i)
        counted[i] = counted[i] && connected[i];
      return is_better = isBetterConnected(counted, num_connected);
    };
    state.verification.verifyTrial(state.scans.names(), is_kept, state.result);
    if (!is_better)
      return StageEnd::kReverted;
    keepMatchedPoses(before, state.result);
    return StageEnd::kDone;
  }

  static std::size_t
  countRegistered(const Slam6DResult& result)
  {
    const std::vector<bool> registered = areRegistered(result);
    return static_cast<std::size_t>(
        std::count(registered.begin(), registered.end(), true));
  }

  static void
  runAgain(const StageList& stages, SlamState& state, SlamContext& context)
  {
    state.is_second_look = true;
    const bool is_whole = runStages(stages, state, context);
    state.is_second_look = false;
    if (!is_whole)
      throw Cancelled();
  }

  StageList recovering_, relaxing_;
};
} // namespace

StagePtr
lookAgain(StageList recovering, StageList relaxing)
{
  return std::make_unique<LookAgain>(std::move(recovering), std::move(relaxing));
}

} // namespace pcl6d::slam6d
