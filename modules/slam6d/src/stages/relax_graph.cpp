// SPDX-License-Identifier: BSD-3-Clause
#include "../task_names.h"
#include "relaxing.h"
#include "stages.h"

#include <pcl6d/slam6d/auto_parameters.h>

namespace pcl6d::slam6d {

namespace {
class RelaxGraph : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    const Slam6DOptions& options = state.options;
    return !state.isWithoutSequence() &&
           (state.improved < state.size() || state.is_second_look) &&
           (options.loop_closing != LoopClosing::kNone || options.relaxation ||
            options.simultaneous);
  }

  void
  prepare(SlamState& state) override
  {
    deriveLoopParameters(state.options, state.result.scans, state.result.parameters);
  }

  std::optional<std::uint64_t>
  key(const SlamState& state) const override
  {
    return taskOf(
        state.inputs.back(), state.result, state.improved, state.options.given_links);
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    GraphStage graph = state.makeGraphStage(context.sharing, state.result.parameters);
    for (const IcpModel& model : state.scans.reduced())
      graph.add(model);
    graph.run(state.result, state.online_loops.closed(), relaxing(state, context));
    context.cancelled = false; // a request during the last round
    return StageEnd::kDone;
  }

  void
  finish(SlamState& state, const SlamContext&) override
  {
    state.improved = state.size();
    state.adjusted = 0;
    state.verification.forgetVariance();
    state.keepInPlane();
  }
};
} // namespace

GraphStage::Observer
relaxing(const SlamState& state, SlamContext& context)
{
  const auto rounds = static_cast<std::size_t>(state.options.relaxation_rounds);
  return [&context, rounds](int round) {
    context.report({"relaxing", static_cast<std::size_t>(round), rounds});
  };
}

StagePtr
relaxGraph()
{
  return std::make_unique<RelaxGraph>();
}

} // namespace pcl6d::slam6d
