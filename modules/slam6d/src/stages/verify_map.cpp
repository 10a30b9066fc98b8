// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

namespace pcl6d::slam6d {

namespace {
class VerifyMap : public Stage {
  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    if (state.options.verify)
      state.verification.verify(state.scans.names(), state.result);
    else
      state.result.verification.reset(); // of the tried starts
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
verifyMap()
{
  return std::make_unique<VerifyMap>();
}

} // namespace pcl6d::slam6d
