// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

#include <algorithm>

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
    if (!state.is_second_look) {
      const auto& scans = state.result.scans;
      const std::size_t first = std::min(state.num_of_earlier_run, scans.size());
      state.recovery.budget().begin(
          {scans.begin() + static_cast<std::ptrdiff_t>(first), scans.end()});
    }
    state.beside = state.map->recover(
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
