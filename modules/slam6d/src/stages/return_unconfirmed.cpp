// SPDX-License-Identifier: BSD-3-Clause
#include "recovery/second_look.h"
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
class ReturnUnconfirmed : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    if (!state.result.verification || state.isWithoutSequence())
      return false;
    for (std::size_t i = state.num_of_earlier_run; i < state.size(); ++i)
      if (isUnconfirmed(state.result, i))
        return true;
    return false;
  }

  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    if (slam6d::returnUnconfirmed(state.num_of_earlier_run, state.result))
      state.verification.verify(state.scans.names(), state.result);
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
returnUnconfirmed()
{
  return std::make_unique<ReturnUnconfirmed>();
}

} // namespace pcl6d::slam6d
