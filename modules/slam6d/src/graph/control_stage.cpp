// SPDX-License-Identifier: BSD-3-Clause
#include "graph/control_stage.h"
#include "graph/graph_stage.h"

#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <algorithm>
#include <chrono>

namespace pcl6d::slam6d {

namespace {
using Links = std::vector<LinkCheck>;

/** \return whether a link of the verified map moved by more than surfaces leave open */
bool
movedLinks(const Links& links, const Poses& before, const Poses& after)
{
  return std::any_of(links.begin(), links.end(), [&](const LinkCheck& link) {
    const auto apart = [&](const Poses& poses) -> Eigen::Vector3d {
      return (poses[link.from].inverse() * poses[link.to]).translation();
    };
    return (apart(after) - apart(before)).norm() > link.deviation;
  });
}

/** History and matched poses follow to the frame of the control points. */
void
moveHistory(const Eigen::Isometry3d& T, Slam6DResult& result)
{
  for (ScanResult& scan : result.scans)
    scan.matched_pose = T * scan.matched_pose;
  for (StageResult& stage : result.stages)
    for (auto& poses : stage.history)
      for (Eigen::Isometry3d& pose : poses)
        pose = T * pose;
}
} // namespace

ControlStage::ControlStage(const ControlOptions& options, unsigned int num_threads)
: options_(options)
{
  options_.num_threads = num_threads;
}

bool
ControlStage::adjust(double least_factor, Slam6DResult& result)
{
  const auto start = std::chrono::steady_clock::now();
  const Poses before = posesOf(result);
  adjusted_ = adjustToControl(
      linksOfMap(before, *result.verification, options_.num_threads, least_factor),
      options_);
  result.control = adjusted_.result;
  if (!adjusted_.result.adjusted)
    return false;
  moveHistory(adjusted_.result.T_control_initial, result);
  for (std::size_t i = 0; i < before.size(); ++i)
    result.scans[i].T_world_scan = adjusted_.poses[i];
  if (!result.graph.poses.empty())
    result.graph.poses = adjusted_.poses;
  StageResult stage;
  stage.kind = StageKind::kControl;
  if (!result.stages.empty())
    stage.agreement_before = stage.agreement_after =
        result.stages.back().agreement_after;
  stage.history = {adjusted_.poses};
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  stage.seconds = spent.count();
  result.stages.push_back(stage);
  return movedLinks(result.verification->links, before, adjusted_.poses);
}

void
ControlStage::takeCovariances(Slam6DResult& result) const
{
  if (!adjusted_.result.adjusted)
    return;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    ScanResult& scan = result.scans[i];
    scan.covariance.reset();
    if (!adjusted_.covariances[i])
      continue;
    PoseCovariance turn = PoseCovariance::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
        scan.T_world_scan.linear();
    const PoseCovariance covariance = eulerCovariance(
        scan.T_world_scan, turn * *adjusted_.covariances[i] * turn.transpose());
    if (covariance.allFinite())
      scan.covariance = 0.5 * (covariance + covariance.transpose());
  }
}

} // namespace pcl6d::slam6d
