// SPDX-License-Identifier: BSD-3-Clause
#include "../pipeline/pipeline.h"
#include "recovery/second_look.h"
#include "stages.h"

#include <utility>

namespace pcl6d::slam6d {

namespace {
class LookAgain : public Stage {
public:
  explicit LookAgain(StageList stages) : stages_(std::move(stages)) {}

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
    const Slam6DResult before = state.result;
    disconnect(state.num_of_earlier_run, state.result);
    state.is_second_look = true;
    const bool is_whole = runStages(stages_, state, context);
    state.is_second_look = false;
    if (!is_whole)
      throw Cancelled();
    if (!isBetterConnected(state.result, before))
      return StageEnd::kReverted;
    keepMatchedPoses(before, state.result);
    return StageEnd::kDone;
  }

private:
  StageList stages_;
};
} // namespace

StagePtr
lookAgain(StageList stages)
{
  return std::make_unique<LookAgain>(std::move(stages));
}

} // namespace pcl6d::slam6d
