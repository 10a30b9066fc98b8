// SPDX-License-Identifier: BSD-3-Clause
#include "registered.h"
#include "stages.h"

#include <pcl6d/common/pose.h>

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
bool
isUnconfirmed(const Slam6DResult& result, std::size_t scan)
{
  return isRegistered(result.scans[scan]) &&
         result.scans[scan].recovered != RecoveredBy::kNone &&
         !result.verification->scans[scan].tied;
}

bool
hasGivenPoses(const SlamState& state)
{
  const auto& scans = state.result.scans;
  return !state.isWithoutSequence() &&
         std::any_of(scans.begin(), scans.end(), [&](const ScanResult& scan) {
           const auto apart =
               distanceBetween(scans.front().initial_pose, scan.initial_pose);
           return apart.translation > 0 || apart.rotation > 0;
         });
}

class ReturnUnconfirmed : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    if (!state.result.verification || !hasGivenPoses(state))
      return false;
    for (std::size_t i = firstNew(state); i < state.size(); ++i)
      if (isUnconfirmed(state.result, i))
        return true;
    return false;
  }

  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    auto& scans = state.result.scans;
    bool is_moved = false; // the scan before
    for (std::size_t i = firstNew(state); i < scans.size(); ++i) {
      const bool is_unconfirmed = isUnconfirmed(state.result, i);
      if (is_unconfirmed) {
        scans[i].state = ScanState::kPredicted;
        scans[i].recovered = RecoveredBy::kNone;
        scans[i].covariance.reset();
        scans[i].rejections = {RejectReason::kInconsistentPose};
      }
      is_moved = is_unconfirmed || (is_moved && !isRegistered(scans[i]));
      if (is_moved)
        state.predict(i);
    }
    state.verification.verify(state.scans.names(), state.result);
    return StageEnd::kDone;
  }

  static std::size_t
  firstNew(const SlamState& state)
  {
    return std::max<std::size_t>(1, state.num_of_earlier_run);
  }
};
} // namespace

StagePtr
returnUnconfirmed()
{
  return std::make_unique<ReturnUnconfirmed>();
}

} // namespace pcl6d::slam6d
