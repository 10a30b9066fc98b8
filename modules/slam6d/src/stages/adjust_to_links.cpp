// SPDX-License-Identifier: BSD-3-Clause
#include "graph/graph_stage.h"
#include "graph/link_adjustment.h"
#include "recovery/second_look.h"
#include "stages.h"

#include <chrono>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Lost scans follow the motion of the registered scan before them. */
void
takeAlong(const SlamState& state, Poses& poses)
{
  if (state.isWithoutSequence())
    return; // scans without links stand beside the map
  const Slam6DResult& result = state.result;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (result.verification->scans[i].tied)
      motion = poses[i] * result.scans[i].T_world_scan.inverse();
    else
      poses[i] = motion * poses[i];
}

class AdjustToLinks : public Stage {
  bool
  isDue(const SlamState& state) const override
  {
    return state.options.verify && state.options.relaxation &&
           state.adjusted < state.size() && state.result.verification && state.map &&
           state.map->matcher().refines();
  }

  StageEnd
  run(SlamState& state, SlamContext&) override
  {
    const auto start = std::chrono::steady_clock::now();
    Slam6DResult& result = state.result;
    const MapTrust trust = result.verification->trust;
    const std::size_t num_connected = countConnected(result);
    state.adjusted = state.size();
    Poses poses = adjustedToLinks(posesOf(result),
                                  *result.verification,
                                  result.parameters.voxel.value,
                                  state.options.num_threads);
    if (poses.empty())
      return StageEnd::kDone;
    takeAlong(state, poses);
    for (std::size_t i = 0; i < poses.size(); ++i)
      result.scans[i].T_world_scan = poses[i];
    state.keepInPlane();
    if (!result.graph.poses.empty())
      result.graph.poses = posesOf(result);
    state.verification.keepVariance();
    state.verification.verify(state.scans.names(), result);
    if (result.verification->trust != trust || countConnected(result) < num_connected)
      return StageEnd::kReverted;
    StageResult stage;
    stage.kind = StageKind::kLinks;
    if (!result.stages.empty())
      stage.agreement_before = stage.agreement_after =
          result.stages.back().agreement_after;
    stage.history = {posesOf(result)};
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    stage.seconds = spent.count();
    result.stages.push_back(std::move(stage));
    return StageEnd::kDone;
  }
};
} // namespace

StagePtr
adjustToLinks()
{
  return std::make_unique<AdjustToLinks>();
}

} // namespace pcl6d::slam6d
