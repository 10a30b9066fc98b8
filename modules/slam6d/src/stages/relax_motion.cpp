// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
class RelaxMotion : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    return num_relaxed_ < state.size();
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    state.motion.describe(state.result.scans);
    if (!state.motion.anyMoved())
      return StageEnd::kDone;
    if (context.progress)
      context.progress({"motion within scans", 0, 1});
    state.motion.relax(state.map->matcher(), state.scans, state.result);
    state.motion.describe(state.result.scans);
    num_relaxed_ = state.size();
    return StageEnd::kDone;
  }

  std::size_t num_relaxed_ = 0; ///< number of scans at the last time
};

class DescribeMotion : public Stage {
  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    if (state.options.leave_out_moving) // poses may have changed
      state.moving.classify(state.verification.scans(), state.result);
    state.motion.describe(state.result.scans);
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
relaxMotion()
{
  return std::make_unique<RelaxMotion>();
}

StagePtr
describeMotion()
{
  return std::make_unique<DescribeMotion>();
}

} // namespace pcl6d::slam6d
