// SPDX-License-Identifier: BSD-3-Clause
#include "relaxing.h"
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
/** Only relaxation leaves out dynamic points. The verdict uses whole scans: at a wrong pose, rays
 * pass through static surfaces, which then look dynamic and are the only evidence against the
 * pose. */
class LeaveOutMoving : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    return state.options.leave_out_moving;
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    const auto& scans = state.verification.scans();
    if (!state.moving.classify(scans, state.result) ||
        !state.moving.isNoticeable(state.result))
      return StageEnd::kDone;
    const auto still = state.moving.still(state.map->matcher().modelOptions(true));
    GraphStage graph = state.makeGraphStage(context.sharing, state.result.parameters);
    for (std::size_t i = 0; i < still.size(); ++i)
      graph.add(still[i] ? *still[i] : scans[i].surfaces());
    try {
      graph.relaxAgain(state.result, relaxing(state, context));
    } catch (const Cancelled&) {
      state.moving.forget(); // a further run repeats this stage
      throw;
    }
    state.moving.classify(scans, state.result);
    return StageEnd::kDone;
  }
};

class KeepInPlane : public Stage {
  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    state.keepInPlane();
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
leaveOutMoving()
{
  return std::make_unique<LeaveOutMoving>();
}

StagePtr
keepInPlane()
{
  return std::make_unique<KeepInPlane>();
}

} // namespace pcl6d::slam6d
