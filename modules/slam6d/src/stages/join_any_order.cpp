// SPDX-License-Identifier: BSD-3-Clause
#include "any_order/global_stage.h"
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
class JoinAnyOrder : public Stage {
  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    const GlobalStage stage(
        state.options, state.scans, state.recovery, [&](const Slam6DParameters& now) {
          return state.makeGraphStage(context.sharing, now);
        });
    stage.run(
        state.groups,
        state.pieces,
        context.sharing,
        [&](const Progress& now) { context.report(now); },
        state.result);
    return StageEnd::kDone;
  }

  void
  finish(SlamState& state, const SlamContext& context) override
  {
    state.keepInPlane();
    auto& groups = state.groups; // a single world
    groups.assign(groups.size(), groups.empty() ? 0 : groups.front());
    state.pieces.clear(); // all have a place in the result
    state.next = state.improved = state.size();
    context.observe(state.result);
  }
};
} // namespace

StagePtr
joinAnyOrder()
{
  return std::make_unique<JoinAnyOrder>();
}

} // namespace pcl6d::slam6d
