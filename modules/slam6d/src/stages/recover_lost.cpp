// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
class RecoverLost : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    return isRecovering(state.options) && !state.is_order_tried && // any order follows
           (state.improved < state.size() || state.is_second_look);
  }

  bool
  isMatching() const override
  {
    return true;
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    if (!state.is_second_look)
      state.recovery.budget().begin(state.result.scans);
    state.map->recover(
        [&](const Progress& now) {
          context.report({"recovering", now.done, now.total});
        },
        state.result);
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
recoverLost()
{
  return std::make_unique<RecoverLost>();
}

} // namespace pcl6d::slam6d
