// SPDX-License-Identifier: BSD-3-Clause
#include "prepare_scans.h"
#include "stages.h"

#include <pcl6d/filters/planar_scan.h>

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** \return whether the initial poses lie in the plane of the first pose */
bool
startInPlane(const std::vector<ScanResult>& scans)
{
  return std::all_of(scans.begin(), scans.end(), [&](const ScanResult& scan) {
    return isInPlane(scans.front().initial_pose, scan.initial_pose);
  });
}

/** \return the parameters derived from the first scans, treated as planar only if their initial
 * poses lie in a plane */
Slam6DParameters
deriveFromScans(const SlamState& state)
{
  const Slam6DOptions& given = state.options;
  if (given.planar_rows || state.isWithoutSequence() ||
      startInPlane(state.result.scans))
    return state.scans.derive(given);
  Slam6DOptions options = given;
  options.planar_rows = 0;
  Slam6DParameters parameters = state.scans.derive(options);
  parameters.planar_rows = {}; // the user gave no value
  return parameters;
}

/** Scans are prepared one by one: cancelling keeps the parameters and the scans prepared before,
 * and the next run continues. */
class PrepareScans : public Stage {
  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    try {
      prepareAll(state, context);
    } catch (const Cancelled&) {
      return StageEnd::kStopped; // the parameters stay: the prepared scans follow them
    }
    return StageEnd::kDone;
  }

  static void
  prepareAll(SlamState& state, SlamContext& context)
  {
    const ProgressCallback report = [&](const Progress& now) { context.report(now); };
    Slam6DOptions& options = state.options;
    if (options.motion.gives_poses && state.motion.anyMoved())
      options.initial_guess = InitialGuess::kOdometry;
    prepareWaiting(state, report);
    if (options.verify || !options.control.points.empty() || options.leave_out_moving ||
        state.isWithoutSequence() || isRecovering(options)) {
      state.verification.setFrames(state.scans.frames());
      state.verification.setRefined(state.map->matcher().refines());
      state.verification.prepare(state.scans.reduced(),
                                 state.scans.measured(),
                                 state.map->matcher().modelOptions(true),
                                 state.result.parameters.voxel.value,
                                 report);
    }
  }
};
} // namespace

void
prepareWaiting(SlamState& state, const ProgressCallback& report)
{
  if (!state.map) {
    state.result.parameters = deriveFromScans(state);
    state.map.emplace(
        state.options, state.result.parameters, state.scans, state.recovery);
  }
  state.scans.prepare(
      state.map->matcher(), state.result.parameters, report, state.result.scans);
}

StagePtr
prepareScans()
{
  return std::make_unique<PrepareScans>();
}

} // namespace pcl6d::slam6d
