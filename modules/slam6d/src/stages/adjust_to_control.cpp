// SPDX-License-Identifier: BSD-3-Clause
#include "graph/control_stage.h"
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
class AdjustToControl : public Stage {
  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    Slam6DResult& result = state.result;
    result.control.reset();
    if (state.options.control.points.empty())
      return StageEnd::kDone;
    ControlStage adjustment(state.options.control, state.options.num_threads);
    if (!state.options.verify)
      state.verification.verify(state.scans.names(), result);
    if (adjustment.adjust(state.verification.leastFactor(), result))
      state.verification.verify(state.scans.names(), result);
    adjustment.takeCovariances(result);
    if (!state.options.verify)
      result.verification.reset();
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
adjustToControl()
{
  return std::make_unique<AdjustToControl>();
}

} // namespace pcl6d::slam6d
