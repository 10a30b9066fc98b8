// SPDX-License-Identifier: BSD-3-Clause
#include "slam_run.h"
#include "stages/prepare_scans.h"
#include "task_names.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Number of static scans kept before the first moving scan, to be matched with it. */
constexpr std::size_t kLastStill = 10;

void
requireTimes(const std::string& name,
             const Points& points,
             const std::vector<double>& times)
{
  if (times.size() != points.size())
    throw BadArgument(name + ": " + std::to_string(times.size()) + " times for " +
                      std::to_string(points.size()) +
                      " points, but each point needs a time");
  const auto bad = std::count_if(
      times.begin(), times.end(), [](double t) { return !std::isfinite(t); });
  if (bad > 0)
    throw BadArgument(name + ": " + std::to_string(bad) +
                      " points have an infinite time or NaN");
}
} // namespace

void
SlamRun::addScan(const Points& points,
                 ScanResult scan,
                 const std::string& given_name,
                 const DriveContext& drive)
{
  auto& scans = state_.result.scans;
  const std::size_t place = scans.size();
  const std::string name = nameOf(given_name);
  const std::size_t finite = countFinite(points);
  if (finite < 3 && state_.scans.isHere(place))
    throw BadArgument(tooFewPoints(name, finite, "with finite coordinates"));
  if (!isRigid(scan.initial_pose) || !isRigid(scan.T_world_scan))
    throw BadArgument(name + ": the initial pose is not a rigid motion");
  if (!isPlace(scan.T_world_scan.translation())) // near the initial pose
    throw BadArgument(name + ": the pose lies 1e9 m or farther from the origin");
  if (!drive.frame.allFinite())
    throw BadArgument(name + ": the covariance of the frame is not finite");
  scan.points = finite;
  scans.push_back(scan);
  if (scan.state == ScanState::kPending)
    state_.predict(place);
  state_.scans.add(points, name, drive);
  const std::uint64_t before = place > 0 ? state_.inputs.back() : 0;
  state_.inputs.push_back(
      context.isFirst() ? inputsOf(before, place, points, scans.back(), drive) : 0);
  try {
    if (state_.scans.isFull(state_.map.has_value()))
      prepareWaiting(state_, nullptr);
  } catch (...) {
    scans.resize(place);
    state_.inputs.resize(place);
    state_.scans.forget(place);
    throw;
  }
}

void
SlamRun::addStill(const Points& points,
                  const ScanResult& scan,
                  const std::string& given_name,
                  const DriveContext& drive)
{
  addUndone(true);
  addScan(points, scan, given_name, drive);
  if (!state_.options.motion.keep_still)
    return;
  last_still_.emplace_back(points, state_.result.scans.back().T_world_scan);
  if (last_still_.size() > kLastStill)
    last_still_.pop_front();
}

void
SlamRun::addMoving(const Points& points,
                   const ScanTimes& times,
                   const Eigen::Isometry3d& pose,
                   const std::string& given_name)
{
  const std::string name = nameOf(given_name);
  if (context.sharing)
    throw BadArgument(
        name +
        ": several processes cannot share the estimation of the motion within scans");
  const std::size_t finite = countFinite(points);
  if (finite < 3)
    throw BadArgument(tooFewPoints(name, finite, "with finite coordinates"));
  if (!isRigid(pose))
    throw BadArgument(name + ": the initial pose is not a rigid motion");
  requireTimes(name, points, times.times);
  for (const auto& [still, still_pose] : std::exchange(last_still_, {}))
    state_.motion.addStill(still, still_pose);
  const auto start = std::chrono::steady_clock::now();
  state_.motion.add(
      state_.size() + state_.motion.numWaiting(), points, times, pose, given_name);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  state_.result.motion_seconds += spent.count();
  addUndone(false);
}

void
SlamRun::addUndone(bool all)
{
  const auto start = std::chrono::steady_clock::now();
  std::vector<MotionStage::Ready> deskewed = state_.motion.take(all);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  state_.result.motion_seconds += spent.count();
  for (MotionStage::Ready& ready : deskewed) {
    ScanResult scan;
    scan.initial_pose = scan.T_world_scan = ready.pose;
    addScan(ready.points, scan, ready.name, {});
  }
}

void
SlamRun::addRegistered(const Points& points,
                       ScanResult earlier,
                       const std::string& name,
                       std::size_t group)
{
  auto& groups = state_.groups;
  if (!groups.empty() && group != groups.front() && !state_.isWithoutSequence())
    throw BadArgument(nameOf(name) + ": is of another run than the first scan, but "
                                     "runs are joined by the initial guess global");
  if (earlier.state == ScanState::kPending)
    throw BadArgument(nameOf(name) + ": is not registered, but pending");
  if (state_.size() > state_.num_of_earlier_run)
    throw BadArgument(nameOf(name) + ": is registered, but an earlier scan is not");
  earlier.matched_pose = earlier.T_world_scan;
  addStill(points, earlier, name);
  groups.push_back(group);
  ++state_.num_of_earlier_run;
}

void
SlamRun::addStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place)
{
  if (!stage)
    throw BadArgument("stage: there is none");
  if (!stages_.empty())
    throw BadArgument("stage " + stage->name() +
                      ": must be added before the first optimize()");
  added_.emplace_back(std::move(stage), place);
}

bool
SlamRun::optimize()
{
  addUndone(true);
  if (state_.result.scans.empty())
    throw BadArgument("no scan was added");
  state_.options.control.validate(state_.size());
  state_.options.given_links = given_links_; // stages may have added links
  if (stages_.empty())
    stages_ = stagesOfRun(added_);
  const bool is_whole = runStages(stages_, state_, context);
  state_.result.left_out = {};
  if (isBounded(state_.options)) {
    state_.result.left_out = state_.recovery.budget().leftOut();
    // Others found many of the scans.
    state_.result.left_out.searches =
        std::min(state_.result.left_out.searches,
                 countScans(state_.result.scans, ScanState::kPredicted));
  }
  return is_whole;
}

void
SlamRun::setSharing(WorkSharing* with)
{
  context.sharing = with;
  state_.scans.setSharing(with);
  state_.verification.setSharing(with);
}

} // namespace pcl6d::slam6d
